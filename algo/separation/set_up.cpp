#include "algo/separation/set_up.h"

namespace mdof::algo {

HalfTurn half_turn(Axis motion, Axis normal, Axis about) {
  return {about == normal ? 1.0 : -1.0, about != motion};
}

AcrossSurface across(Axis motion, Surface surface) {
  const LocalError local = surface == Surface::side ? kDy : kDz;
  const auto& names = error_names(motion);
  const std::size_t named = names[0].local == local ? 0 : 1;
  return {*axis_from(std::string_view(names[named].name).substr(1, 1)), named};
}

double place_on_target(const ReadAt& at, const SetUp& set_up, double position_m) {
  const double in_C = at.place_m - at.sides.target_travel_m(position_m);
  return set_up.turn.end_for_end ? set_up.shift_m - in_C : in_C - set_up.shift_m;
}

}  // namespace mdof::algo
