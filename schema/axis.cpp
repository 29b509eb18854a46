#include "schema/axis.h"

#include <cstddef>

namespace mdof {

char letter(Axis axis) {
  return "XYZ"[static_cast<std::size_t>(axis)];
}

std::optional<Axis> axis_from(std::string_view text) {
  if (text == "X" || text == "x") return Axis::x;
  if (text == "Y" || text == "y") return Axis::y;
  if (text == "Z" || text == "z") return Axis::z;
  return std::nullopt;
}

const std::array<ErrorName, 5>& error_names(Axis axis) {
  static const std::array<std::array<ErrorName, 5>, 3> names = {{
      {{{"EYX", "EYX_um", kDy, 1, false},
        {"EZX", "EZX_um", kDz, 1, false},
        {"EAX", "EAX_urad", kEx, 1, true},
        {"EBX", "EBX_urad", kEy, 1, true},
        {"ECX", "ECX_urad", kEz, 1, true}}},
      {{{"EXY", "EXY_um", kDy, -1, false},
        {"EZY", "EZY_um", kDz, 1, false},
        {"EAY", "EAY_urad", kEy, -1, true},
        {"EBY", "EBY_urad", kEx, 1, true},
        {"ECY", "ECY_urad", kEz, 1, true}}},
      {{{"EXZ", "EXZ_um", kDy, 1, false},
        {"EYZ", "EYZ_um", kDz, 1, false},
        {"EAZ", "EAZ_urad", kEy, 1, true},
        {"EBZ", "EBZ_urad", kEz, 1, true},
        {"ECZ", "ECZ_urad", kEx, 1, true}}},
  }};
  return names[static_cast<std::size_t>(axis)];
}

std::array<std::array<double, 3>, 3> local_axes(Axis axis) {
  switch (axis) {
    case Axis::y:  // x = +Y, y = -X, z = +Z
      return {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}};
    case Axis::z:  // x = +Z, y = +X, z = +Y
      return {{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}}};
    case Axis::x:
      break;
  }
  return {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

std::array<double, 3> to_local(Axis axis, const std::array<double, 3>& v) {
  const auto axes = local_axes(axis);
  std::array<double, 3> out{};
  for (std::size_t j = 0; j < 3; ++j) {
    out[j] = axes[0][j] * v[0] + axes[1][j] * v[1] + axes[2][j] * v[2];
  }
  return out;
}

Errors5 named_from_local(Axis axis, const Errors5& local) {
  Errors5 named{};
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& n = error_names(axis)[i];
    named[i] = n.sign * local[n.local];
  }
  return named;
}

Errors5 local_from_named(Axis axis, const Errors5& named) {
  Errors5 local{};
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& n = error_names(axis)[i];
    local[n.local] = n.sign * named[i];
  }
  return local;
}

Covariance5 named_from_local(Axis axis, const Covariance5& local) {
  Covariance5 named{};
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = 0; j < 5; ++j) {
      const auto& a = error_names(axis)[i];
      const auto& b = error_names(axis)[j];
      named[5 * i + j] = a.sign * b.sign * local[5U * a.local + b.local];
    }
  }
  return named;
}

Errors5 named_from_local(const MovingAxis& moving, const Errors5& local) {
  Errors5 named = named_from_local(moving.axis, local);
  for (double& x : named) x *= moving.sides.error_sign();
  return named;
}

Errors5 local_from_named(const MovingAxis& moving, const Errors5& named) {
  Errors5 local = local_from_named(moving.axis, named);
  for (double& x : local) x *= moving.sides.error_sign();
  return local;
}

}  // namespace mdof
