#include "algo/separation/grid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

#include "schema/base/number/number_text.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

std::string in_mm(double m) {
  return plain_number(to_mm(m), 7) + " mm";
}

struct Clusters {
  std::vector<double> at;       // mean of each cluster, ascending
  std::vector<std::size_t> of;  // index of the cluster of each value
};

Clusters clusters_of(const std::vector<double>& values, double match_m) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  Clusters found;
  found.of.resize(values.size());
  double lowest = 0, count = 0;
  for (const std::size_t i : order) {
    if (found.at.empty() || values[i] - lowest > match_m) {
      lowest = values[i];
      count = 0;
      found.at.push_back(0);
    }
    found.of[i] = found.at.size() - 1;
    found.at.back() += (values[i] - found.at.back()) / ++count;
  }
  return found;
}

// Rounds the positions to equal steps and returns the step.
Result<double> snap_to_steps(std::vector<double>& position_m, double match_m) {
  double least = position_m[1] - position_m[0];
  for (std::size_t i = 1; i < position_m.size(); ++i)
    least = std::min(least, position_m[i] - position_m[i - 1]);
  const double whole = std::round((position_m.back() - position_m.front()) / least);
  const double first = position_m.front(), step = (position_m.back() - first) / whole;
  for (double& x : position_m) {
    const double on = first + std::round((x - first) / step) * step;
    if (std::abs(x - on) > match_m)
      return bad_input(
          "the positions are not equally spaced (" + in_mm(x) + " is " + in_mm(std::abs(x - on)) +
              " away from a multiple of the step of " + in_mm(step) +
              "), so the probe does not measure the same places of the target after a shift",
          Remedy::measure_equal_intervals);
    x = on;
  }
  return step;
}

// Place on the target as a number of steps. Step 0 is the place that an unshifted set-up measures
// at the first position.
Result<long> step_on_target(const ReadAt& at, const SetUp& set_up, std::size_t number,
                            const Grid& grid, double position_m, double match_m) {
  const double origin = place_on_target(at, {}, grid.position_m.front());
  const double steps = (place_on_target(at, set_up, position_m) - origin) / grid.step_m;
  const double off = (steps - std::round(steps)) * grid.step_m;
  if (std::abs(off) <= match_m) return std::lround(steps);
  if (set_up.turn.end_for_end)
    return bad_input("set-up " + std::to_string(number) +
                     ": the centre of the turn of the target is at " + in_mm(set_up.shift_m / 2) +
                     ", so this set-up measures places of the target that are " +
                     in_mm(std::abs(off)) +
                     " away from the places that the first set-up measures; turn the target about "
                     "a measured place, or about the middle between two measured places");
  return bad_input(
      "set-up " + std::to_string(number) + ": the shift of " + in_mm(set_up.shift_m) + " is " +
          in_mm(std::abs(off)) + " away from a multiple of the step of " + in_mm(grid.step_m) +
          ", so this set-up does not measure the same places of the target as the first set-up",
      Remedy::shift_by_intervals);
}

bool moved_along(const SetUp& set_up) {
  return set_up.shift_m != 0 || set_up.turn.end_for_end;
}

// For set-ups without shift along the motion: each position has exactly one place on the target.
void add_unshifted_places(const ReadAt& at, Grid& grid) {
  const std::size_t n = grid.position_m.size();
  for (const double x : grid.position_m) grid.place_m.push_back(place_on_target(at, {}, x));
  const bool falling = grid.place_m.front() > grid.place_m.back();
  if (falling) std::reverse(grid.place_m.begin(), grid.place_m.end());
  for (const std::size_t i : grid.at_position) grid.at_place.push_back(falling ? n - 1 - i : i);
}

Status add_shifted_places(const ReadAt& at, const std::vector<SetUp>& set_ups, double match_m,
                          Grid& grid) {
  std::vector<long> step_of;
  for (std::size_t k = 0; k < set_ups.size(); ++k) {
    for (std::size_t i = 0; i < set_ups[k].position_m.size(); ++i) {
      const double x = grid.position_m[grid.at_position[step_of.size()]];
      MDOF_TRY(const long step, step_on_target(at, set_ups[k], k + 1, grid, x, match_m));
      step_of.push_back(step);
    }
  }
  std::vector<long> steps = step_of;
  std::sort(steps.begin(), steps.end());
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  const double origin = place_on_target(at, {}, grid.position_m.front());
  for (const long step : steps)
    grid.place_m.push_back(origin + static_cast<double>(step) * grid.step_m);
  for (const long step : step_of)
    grid.at_place.push_back(static_cast<std::size_t>(
        std::lower_bound(steps.begin(), steps.end(), step) - steps.begin()));
  return {};
}

}  // namespace

Result<Grid> grid_of(const ReadAt& at, const std::vector<SetUp>& set_ups, double match_m) {
  std::vector<double> all;
  for (const SetUp& s : set_ups) all.insert(all.end(), s.position_m.begin(), s.position_m.end());
  const Clusters clusters = clusters_of(all, match_m);
  Grid grid;
  grid.position_m = clusters.at;
  grid.at_position = clusters.of;
  if (grid.position_m.size() < 3)
    return bad_input("the set-ups have " + std::to_string(grid.position_m.size()) +
                         " different positions, but at least 3 are needed",
                     Remedy::measure_three_positions);
  if (std::none_of(set_ups.begin(), set_ups.end(), moved_along)) {
    add_unshifted_places(at, grid);
    return grid;
  }
  MDOF_TRY(grid.step_m, snap_to_steps(grid.position_m, match_m));
  MDOF_CHECK(add_shifted_places(at, set_ups, match_m, grid));
  return grid;
}

}  // namespace mdof::algo
