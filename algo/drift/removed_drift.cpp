#include "algo/drift/removed_drift.h"

#include <utility>

#include "algo/drift/run_drift.h"
#include "algo/model/restate.h"
#include "schema/recording/run_options.h"

namespace mdof::algo {
namespace {

// Converts shifts of the errors from the reference point "fixture" to the reference point of the
// run.
PointShifts restated(const PointShifts& at_fixture, const Run& run) {
  if (run.header.stated == kAtFixture) return at_fixture;
  const Model model = model_of(run);
  PointShifts shifts(at_fixture.size());
  for (std::size_t j = 0; j < shifts.size(); ++j) {
    const MeasuredPoint& p = run.points[j];
    if (!p.errors.valid) continue;
    const double travel_m = run.header.sides.target_travel_m(p.point.position_m);
    const auto stated = [&](const AxisErrors& errors, const StatedAt& from, const StatedAt& to) {
      return restate(errors, model, run.header.moving(), travel_m, from, to);
    };
    AxisErrors shifted = stated(p.errors, run.header.stated, kAtFixture);
    for (std::size_t k = 0; k < kErrorCount; ++k) shifted.local[k] += at_fixture[j][k];
    shifted = stated(shifted, kAtFixture, run.header.stated);
    for (std::size_t k = 0; k < kErrorCount; ++k)
      shifts[j][k] = shifted.local[k] - p.errors.local[k];
  }
  return shifts;
}

}  // namespace

std::vector<Contributor> removed_drift(const Run& run) {
  if (!run_options(run.header).remove_drift) return {};
  const std::vector<MeasuredPoint> points = restate(run, kAtFixture).points;
  const DriftOfRun drift(points);
  std::vector<PointShifts> parts;
  for (const PointShifts& part : drift.removal_shifts(points)) parts.push_back(restated(part, run));
  if (parts.empty()) return {};
  Contributor removed;
  removed.name = {ContributorKind::removed_drift};
  removed.declared = {1, UncertaintyShape::normal, drift.freedom()};
  removed.parts = [parts = std::move(parts)] { return parts; };
  return {std::move(removed)};
}

}  // namespace mdof::algo
