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
  if (!lines) return in_context("run " + std::to_string(run.header.id), std::move(lines.error()));
  return lines;
}

ParallelismLine between(const ReferenceLine& a, const ReferenceLine& b) {
  return {a.slope_rad, b.slope_rad, b.slope_rad - a.slope_rad};
}

std::string in_mm_text(double from_m, double to_m) {
  return plain_number(to_mm(from_m), 6) + " to " + plain_number(to_mm(to_m), 6) + " mm";
}

// If the motion is curved, the fitted line depends on the range of the fit. Therefore runs with
// little common travel are not compared.
Status common_travel(const ReferenceLines& a, const ReferenceLines& b, Parallelism& found) {
  found.from_m = std::max(a.first_m, b.first_m);
  found.to_m = std::min(a.last_m, b.last_m);
  const double longer = std::max(a.last_m - a.first_m, b.last_m - b.first_m);
  if (found.to_m - found.from_m >= kLeastShare * longer) return {};
  return bad_input("the travel that run " + std::to_string(found.run_a) + " (" +
                   in_mm_text(a.first_m, a.last_m) + ") and run " + std::to_string(found.run_b) +
                   " (" + in_mm_text(b.first_m, b.last_m) +
                   ") have in common is less than half of the longer travel; measure both runs "
                   "over the same travel");
}

}  // namespace

Result<Parallelism> parallelism(const Run& run_a, const Run& run_b, bool take_partial) {
  if (run_a.header.axis != run_b.header.axis)
    return bad_input("run " + std::to_string(run_a.header.id) + " measures axis " +
                         letter(run_a.header.axis) + " and run " + std::to_string(run_b.header.id) +
                         " measures axis " + letter(run_b.header.axis) +
                         ", but parallelism compares two motions along one axis",
                     Remedy::compare_two_axes);
  MDOF_CHECK(check_usable({&run_a, &run_b}, take_partial, "parallelism"));
  Parallelism found;
  found.run_a = run_a.header.id;
  found.run_b = run_b.header.id;
  found.axis = run_a.header.axis;
  found.simulated = run_a.header.simulated || run_b.header.simulated;
  const Motion motion_a = motion_of(run_a), motion_b = motion_of(run_b);
  for (std::size_t named = 0; named < kStraightnessErrors; ++named) {
    MDOF_TRY(const ReferenceLines a, lines_of(run_a, motion_a, named));
    MDOF_TRY(const ReferenceLines b, lines_of(run_b, motion_b, named));
    MDOF_CHECK(common_travel(a, b, found));
    found.planes.push_back({error_names(found.axis)[named].name,
                            between(a.end_point, b.end_point),
                            between(a.least_squares, b.least_squares),
                            between(a.minimum_zone, b.minimum_zone),
                            {}});
  }
  return found;
}

}  // namespace mdof::algo
