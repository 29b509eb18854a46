#include "drivers/simulator/raw_reading.h"

#include <algorithm>
#include <vector>

#include "schema/units.h"

namespace mdof::drivers {
namespace {

// Solves t + linearity(t) = y for t. `nodes` are pairs of a reading x and its correction c. The
// inverse correction is linear between the points (x + c, c).
double without_linearity(const std::vector<std::array<double, 2>>& nodes, double y) {
  if (nodes.empty()) return y;
  const auto corrected = [](const std::array<double, 2>& node) { return node[0] + node[1]; };
  if (y <= corrected(nodes.front())) return y - nodes.front()[1];
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const double y0 = corrected(nodes[i - 1]), y1 = corrected(nodes[i]);
    if (y <= y1)
      return y - (nodes[i - 1][1] + (nodes[i][1] - nodes[i - 1][1]) * (y - y0) / (y1 - y0));
  }
  return y - nodes.back()[1];
}

struct Range {
  double low_um, high_um;
};

Range range_of(const Probe& probe) {
  const double range_um = to_um(probe.range_m);
  if (probe.calibration.reads_gap) return {0, range_um};
  return {-range_um / 2, range_um / 2};
}

}  // namespace

RawReading raw_reading(const Probe& probe, double displacement_m) {
  const Calibration& calibration = probe.calibration;
  const double displacement_um = to_um(displacement_m);
  const double t = without_linearity(calibration.linearity,
                                     calibration.reads_gap ? -displacement_um : displacement_um);
  const double raw_um = t + calibration.offset_um;
  const Range range = range_of(probe);
  const double held_um = std::clamp(raw_um, range.low_um, range.high_um);
  return {held_um, held_um != raw_um};
}

double end_of_range_um(const Probe& probe) {
  return range_of(probe).high_um;
}

}  // namespace mdof::drivers
