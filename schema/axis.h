// A machine axis, its local frame, and the ISO 230-1 names of its errors.
//
// Local frame of an axis: x is along the motion, z is "up" (normal of the top target plane), y = z
// × x. The local axes (x, y, z) are these machine axes:
//   X: (+X, +Y, +Z)      Y: (+Y, -X, +Z)      Z: (+Z, +X, +Y), a cyclic permutation
// The five errors in the local frame are δy, δz, εx, εy, εz. Their ISO names for each axis:
//   X: EYX = δy   EZX = δz   EAX = εx   EBX = εy   ECX = εz
//   Y: EXY = -δy  EZY = δz   EAY = -εy  EBY = εx   ECY = εz
//   Z: EXZ = δy   EYZ = δz   EAZ = εy   EBZ = εz   ECZ = εx
// Error = actual - nominal. The local errors are errors of the target in the metrology frame. The
// errors with ISO names are errors of the moving body. If the target moves, both errors are equal.
// If the fixture moves, the local errors of a run are the negative errors of the fixture. To first
// order these are the errors of the target (algo/model/moving_body.h).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "schema/rig/sides.h"

namespace mdof {

using Vec3 = std::array<double, 3>;

enum class Axis { x, y, z };
char letter(Axis axis);                                  // 'X'
std::optional<Axis> axis_from(std::string_view letter);  // "X", "Y", "Z"

// Index of a local error in an Errors5 of local errors. The errors kDy and kDz are in m, the others
// in rad.
enum LocalError { kDy = 0, kDz = 1, kEx = 2, kEy = 3, kEz = 4 };
inline constexpr int kErrorCount = 5;
using Errors5 = std::array<double, 5>;
using Covariance5 = std::array<double, 25>;  // row-major, symmetric

// An error of an axis with its ISO name. Results list the errors in this order: the two
// straightness errors, then the rotations A, B and C about X, Y and Z.
struct ErrorName {
  const char* name;  // "EYX"
  const char* key;   // "EYX_um" or "EAX_urad": the name with its unit
  LocalError local;
  double sign;  // error with the ISO name = sign * local error
  bool angle;
};
const std::array<ErrorName, 5>& error_names(Axis axis);

// The columns are the local axes in machine coordinates: p_machine = axes * p_local.
std::array<std::array<double, 3>, 3> local_axes(Axis axis);
std::array<double, 3> to_local(Axis axis, const std::array<double, 3>& v_machine);

// Conversion to and from the errors with ISO names, for errors of the target.
Errors5 named_from_local(Axis axis, const Errors5& local);
Errors5 local_from_named(Axis axis, const Errors5& named);
Covariance5 named_from_local(Axis axis, const Covariance5& local);

// An axis with the body that moves along it.
struct MovingAxis {
  Axis axis = Axis::x;
  Sides sides;
};
// Conversion to and from the errors with ISO names, for errors of the moving body. For a
// covariance, use the function for errors of the target: a covariance does not change if all errors
// change their sign.
Errors5 named_from_local(const MovingAxis& moving, const Errors5& local);
Errors5 local_from_named(const MovingAxis& moving, const Errors5& named);

// Converts an SI value to the unit of the key, µm or µrad. The factor of both units is 1e6.
inline double to_key_unit(double si) {
  return si * 1e6;
}

}  // namespace mdof
