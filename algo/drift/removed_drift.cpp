#include "algo/drift/removed_drift.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/drift/run_drift.h"
#include "algo/model/restate.h"
#include "algo/model/solver.h"
#include "schema/recording/run_options.h"

namespace mdof::algo {
namespace {

constexpr double kLeastShift = 1e-13;  // m or rad; smaller differences are due to rounding

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

// The points with the errors before a drift was subtracted.
Result<std::vector<MeasuredPoint>> as_measured(const Rig& rig, const Run& run) {
  MDOF_TRY(const Solver solver, Solver::create(rig, model_of(run)));
  std::vector<MeasuredPoint> points = run.points;
  for (MeasuredPoint& p : points)
    if (p.errors.valid) p.errors = solved(solver, p.point, run.header.moving(), kAtFixture);
  return points;
}

// Differences between the drift that was subtracted and the drift that is estimated now.
PointShifts other_course(const std::vector<MeasuredPoint>& stored,
                         const std::vector<MeasuredPoint>& estimated) {
  PointShifts shifts(stored.size());
  for (std::size_t j = 0; j < stored.size(); ++j)
    for (std::size_t k = 0; k < kErrorCount && estimated[j].errors.valid; ++k)
      shifts[j][k] = estimated[j].errors.local[k] - stored[j].errors.local[k];
  return shifts;
}

bool any(const PointShifts& shifts) {
  return std::any_of(shifts.begin(), shifts.end(), [](const Errors5& of) {
    return std::any_of(of.begin(), of.end(), [](double x) { return std::abs(x) > kLeastShift; });
  });
}

}  // namespace

Result<std::vector<Contributor>> removed_drift(const Rig& rig, const Run& run) {
  if (!run_options(run.header).remove_drift) return std::vector<Contributor>{};
  MDOF_TRY(const std::vector<MeasuredPoint> measured, as_measured(rig, run));
  const DriftOfRun drift(measured);
  std::vector<PointShifts> parts = drift.removal_shifts(measured);
  parts.push_back(other_course(restate(run, kAtFixture).points, drift.without(measured)));
  if (!any(parts.back())) parts.pop_back();
  if (parts.empty()) return std::vector<Contributor>{};
  for (PointShifts& part : parts) part = restated(part, run);
  Contributor removed;
  removed.name = {ContributorKind::removed_drift};
  removed.declared = {1, UncertaintyShape::normal, drift.freedom()};
  removed.parts = [parts = std::move(parts)] { return parts; };
  return std::vector<Contributor>{std::move(removed)};
}

}  // namespace mdof::algo
