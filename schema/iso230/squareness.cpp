#include "schema/iso230/squareness.h"

namespace mdof {

const char* squareness_name(AxisPair axes) {
  if (axes.b == Axis::y) return "EC0Y";
  return axes.a == Axis::x ? "EB0Z" : "EA0Z";
}

int squareness_sign(AxisPair axes) {
  return axes.a == Axis::x && axes.b == Axis::z ? -1 : 1;
}

std::string squareness_sense(AxisPair axes, const std::string& degrees) {
  return std::string("the angle from +") + letter(axes.a) + " to +" + letter(axes.b) + " is 90" +
         degrees + (squareness_sign(axes) > 0 ? " + " : " - ") + squareness_name(axes);
}

std::size_t straightness_along(Axis of, Axis along) {
  return error_names(of)[0].name[1] == letter(along) ? 0 : 1;
}

double squareness_of(AxisPair axes, double slope_a_rad, double slope_b_rad,
                     const SquareArtefact& artefact) {
  return squareness_sign(axes) *
         (-slope_b_rad - slope_a_rad + artefact.corner * artefact.angle_error_rad);
}

}  // namespace mdof
