#include "algo/iso230/parallelism.h"

#include <algorithm>
#include <string>

#include "algo/iso230/reference_lines.h"
#include "algo/iso230/target_means.h"
#include "algo/model/restate.h"
#include "algo/sequence/usable_runs.h"
#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kStraightnessErrors = 2;  // indices 0 and 1 of error_names()

// Smallest ratio of the common travel to the longer travel.
constexpr double kLeastShare = 0.5;
// Targets at random distances from equal intervals differ between two runs. Share of the interval.
constexpr double kTolerance = 0.1;

std::string run_text(const Run& run) {
  return "run " + std::to_string(run.header.id);
}

struct Extent {
  double first_m = 0, last_m = 0, interval_m = 0;
  double length_m() const { return last_m - first_m; }
  std::string text() const {
    return plain_number(to_mm(first_m), 6) + " to " + plain_number(to_mm(last_m), 6) + " mm";
  }
};

Result<Extent> extent_of(const Run& run) {
  const auto means = target_means(run.header.moving(), run.points, Approach::both);
  const std::vector<double> travels_m = own_travels(run.header.sides, means);
  if (travels_m.empty()) return bad_input(run_text(run) + " has no points with error values");
  const auto [first, last] = std::minmax_element(travels_m.begin(), travels_m.end());
  const auto intervals = static_cast<double>(std::max<std::size_t>(travels_m.size() - 1, 1));
  return Extent{*first, *last, (*last - *first) / intervals};
}

Run cut(Run run, const Extent& travel, double from_m, double to_m) {
  const double tolerance_m = kTolerance * travel.interval_m;
  std::erase_if(run.points, [&](const MeasuredPoint& p) {
    const double at_m = run.header.sides.moving_body_travel_m(p.point.position_m);
    return at_m < from_m - tolerance_m || at_m > to_m + tolerance_m;
  });
  return run;
}

struct Motion {
  std::vector<double> travel_m;
  std::vector<TargetMean> means;
};

Motion motion_of(const Run& measured) {
  const Run run = restate(measured, kAtFixture);
  auto means = target_means(run.header.moving(), run.points, Approach::both);
  auto travel = own_travels(run.header.sides, means);
  return {std::move(travel), std::move(means)};
}

Result<ReferenceLines> lines_of(const Run& run, const Motion& motion, std::size_t named) {
  auto lines = reference_lines(motion.travel_m, column(motion.means, named));
  if (!lines) return in_context(run_text(run), std::move(lines.error()));
  return lines;
}

ParallelismLine between(const ReferenceLine& a, const ReferenceLine& b) {
  return {a.slope_rad, b.slope_rad, b.slope_rad - a.slope_rad};
}

}  // namespace

Result<CommonTravel> over_common_travel(const Run& a, const Run& b) {
  if (a.header.axis != b.header.axis)
    return bad_input(run_text(a) + " measures axis " + letter(a.header.axis) + " and " +
                         run_text(b) + " measures axis " + letter(b.header.axis) +
                         ", but two motions along one axis are compared",
                     Remedy::compare_two_axes);
  MDOF_TRY(const Extent of_a, extent_of(a));
  MDOF_TRY(const Extent of_b, extent_of(b));
  const double from_m = std::max(of_a.first_m, of_b.first_m);
  const double to_m = std::min(of_a.last_m, of_b.last_m);
  if (to_m - from_m < kLeastShare * std::max(of_a.length_m(), of_b.length_m()))
    return bad_input("the travel that " + run_text(a) + " (" + of_a.text() + ") and " +
                     run_text(b) + " (" + of_b.text() +
                     ") have in common is less than half of the longer travel; measure both runs "
                     "over the same travel");
  return CommonTravel{cut(a, of_a, from_m, to_m), cut(b, of_b, from_m, to_m), from_m, to_m};
}

Result<Parallelism> parallelism(const Run& run_a, const Run& run_b, bool take_partial) {
  MDOF_CHECK(check_usable({&run_a, &run_b}, take_partial, "parallelism"));
  MDOF_TRY(const CommonTravel common, over_common_travel(run_a, run_b));
  Parallelism found;
  found.run_a = run_a.header.id;
  found.run_b = run_b.header.id;
  found.axis = run_a.header.axis;
  found.simulated = run_a.header.simulated || run_b.header.simulated;
  found.from_m = common.from_m;
  found.to_m = common.to_m;
  const Motion motion_a = motion_of(common.a), motion_b = motion_of(common.b);
  for (std::size_t named = 0; named < kStraightnessErrors; ++named) {
    MDOF_TRY(const ReferenceLines a, lines_of(run_a, motion_a, named));
    MDOF_TRY(const ReferenceLines b, lines_of(run_b, motion_b, named));
    found.planes.push_back({error_names(found.axis)[named].name,
                            between(a.end_point, b.end_point),
                            between(a.least_squares, b.least_squares),
                            between(a.minimum_zone, b.minimum_zone),
                            {}});
  }
  return found;
}

}  // namespace mdof::algo
