// Averages the position and the probes of a dwell.
#include <algorithm>
#include <cmath>

#include "algo/points/dwell.h"
#include "algo/points/flags.h"
#include "algo/points/over_range.h"
#include "algo/points/robust_mean.h"
#include "algo/points/scan_fingerprint.h"

namespace mdof::algo {
namespace {

constexpr double kCoarseSteps = 3.5;  // in resolution steps; smaller changes are rounding

bool all_finite(std::span<const double> values) {
  return std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); });
}

}  // namespace

Point DwellDetector::average(std::size_t from, std::size_t to) {
  Point point;
  point.begin_ns = buffer_.time_ns[from];
  point.end_ns = buffer_.time_ns[to - 1];
  point.samples = to - from;
  const std::span<const double> encoder(&buffer_.encoder_m[from], to - from);
  const RobustMean position = robust_mean(encoder, summary_.tolerance_m, scratch_);
  point.position_m = position.mean;
  point.direction = direction_;
  if (position.rejected > 0) add_flag(point, Flag::spike, "encoder");
  for (std::size_t k = 0; k < probe_ids_.size(); ++k) average_probe(k, from, to, point);
  for (std::size_t i = from + 1; i < to; ++i) {
    if (buffer_.time_ns[i] - buffer_.time_ns[i - 1] > kGapPeriods * period_ns_) {
      add_flag(point, Flag::gap);
    }
  }
  point.scan_fingerprint = scan_fingerprint(buffer_, from, to);
  if (truncated_) add_flag(point, Flag::truncated);
  const double jumped_m =
      point.end_ns < last_jump_.time_ns ? jumped_m_ - last_jump_.size_m : jumped_m_;
  if (std::abs(jumped_m) > summary_.tolerance_m) add_flag(point, Flag::jump);
  return point;
}

// Returns the usable readings of a probe. Each sample of the probe is used once, by means of
// probe_is_new. Without quality marks, every finite value is usable.
std::span<const double> DwellDetector::own_readings(std::size_t probe, std::size_t from,
                                                    std::size_t to, std::size_t& usable_rows,
                                                    OverRange& over_range) {
  const auto& column = buffer_.probe_m[probe];
  const auto& quality = buffer_.probe_quality[probe];
  const auto& fresh = buffer_.probe_is_new[probe];
  const std::span<const double> all(&column[from], to - from);
  if (quality.empty() && fresh.empty() && all_finite(all)) return all;
  finite_.clear();
  usable_rows = 0;
  for (std::size_t i = from; i < to; ++i) {
    const Quality q = quality.empty() ? Quality::good : quality[i];
    if (q == Quality::over_range) over_range.add(column[i]);
    if (!usable(q) || !std::isfinite(column[i])) continue;
    ++usable_rows;
    if (fresh.empty() || fresh[i]) finite_.push_back(column[i]);
  }
  return finite_;
}

void DwellDetector::average_probe(std::size_t probe, std::size_t from, std::size_t to,
                                  Point& point) {
  OverRange over_range;
  std::size_t usable_rows = to - from;
  const std::span<const double> readings = own_readings(probe, from, to, usable_rows, over_range);
  const std::string& id = probe_ids_[probe];
  if (over_range.count > 0) add_flag(point, Flag::saturated, id);
  const double step = resolution_.step_m(probe);
  const double coarse = std::max(1e-3 * probe_range_m_[probe], kCoarseSteps * step);
  const bool few = readings.size() < kMinScans;
  const RobustMean mean = few ? RobustMean{} : robust_mean(readings, coarse, scratch_);
  const bool lost = usable_rows < kMinScans || 2 * usable_rows < to - from ||
                    is_saturated(over_range, to - from, mean.mean, mean.sd);
  if (!lost && few) add_flag(point, Flag::slow, id);
  if (lost) add_flag(point, Flag::lost, id);
  if (lost || few) {
    point.probe_m.push_back(kNaN);
    point.probe_u_m.push_back(kNaN);
    point.probe_sd_m.push_back(kNaN);
    return;
  }
  if (usable_rows + over_range.count < to - from) add_flag(point, Flag::missing, id);
  if (mean.rejected > 0) add_flag(point, Flag::spike, id);
  watch_.take_stop(probe, mean, step);
  point.probe_m.push_back(mean.mean);
  const double u_m = with_resolution(mean.u, mean.sd, step);
  point.probe_u_m.push_back(u_with_over_range(u_m, mean.mean, mean.sd, over_range, to - from));
  point.probe_sd_m.push_back(mean.sd);
}

}  // namespace mdof::algo
