#include "algo/separation/request_check.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "algo/separation/shared_readings.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMostReadings = 3000;
constexpr double kMost_m = 1e6;

Status check_set_up(const SetUp& set_up, std::size_t number) {
  const std::string of = "set-up " + std::to_string(number) + ": ";
  const auto wrong = [](double x) { return !(std::abs(x) <= kMost_m); };
  if (set_up.position_m.size() < 3)
    return bad_input(of + std::to_string(set_up.position_m.size()) +
                     " readings, but at least 3 are needed; measure at three or more positions");
  for (const auto* values : {&set_up.position_m, &set_up.error_m, &set_up.u_m})
    if (std::any_of(values->begin(), values->end(), wrong))
      return bad_input(of + "a value is not a finite number below 1000 km; check the units");
  if (wrong(set_up.shift_m))
    return bad_input(of + "the shift is not a finite number below 1000 km; check the unit");
  if (std::any_of(set_up.u_m.begin(), set_up.u_m.end(), [](double u) { return u < 0; }))
    return bad_input(of + "a standard uncertainty is negative; give 0 or greater");
  return {};
}

// True: the target has the same pose in all set-ups.
bool are_set_ups_identical(const SeparationRequest& request) {
  return std::all_of(request.set_ups.begin(), request.set_ups.end(), [&](const SetUp& s) {
    return std::abs(s.shift_m) <= request.match_m && !s.turn.end_for_end && s.turn.height_sign > 0;
  });
}

}  // namespace

Status check_request(const SeparationRequest& request) {
  if (request.set_ups.size() < 2)
    return bad_input(
        "one set-up cannot separate the machine from the target; measure again with the "
        "target turned or shifted");
  if (!(std::abs(request.at.place_m) <= kMost_m))
    return bad_input(
        "the position of the probe is not a finite number below 1000 km; check the unit");
  std::size_t readings = 0;
  for (std::size_t k = 0; k < request.set_ups.size(); ++k) {
    MDOF_CHECK(check_set_up(request.set_ups[k], k + 1));
    readings += request.set_ups[k].position_m.size();
  }
  if (readings > kMostReadings)
    return bad_input("these set-ups have " + std::to_string(readings) + " readings, but at most " +
                     std::to_string(kMostReadings) +
                     " can be separated at once; leave some set-ups out");
  if (!are_set_ups_identical(request)) return {};
  return bad_input(
      "the target has the same position and orientation in all set-ups, so the machine cannot be "
      "separated from the target. If the target was turned, state in which set-up; if it was "
      "shifted, state how far. If neither, measure a further set-up with the target turned or "
      "shifted");
}

Status check_shared(const Grid& grid, const std::vector<SetUp>& set_ups) {
  for (const auto* at : {&grid.at_position, &grid.at_place}) {
    const std::vector<bool> shared = are_shared(*at, set_ups);
    if (std::none_of(shared.begin(), shared.end(), [](bool is) { return is; }))
      return bad_input(std::string("no two set-ups measure the same point of the ") +
                       (at == &grid.at_position ? "machine" : "target") +
                       ", so the errors cannot be separated; measure at the same positions, and "
                       "shift the target by less than the travel");
  }
  return {};
}

}  // namespace mdof::algo
