// Conversions between units. Only this file contains the powers of ten. Internal values are in SI
// units (m, rad, s, V; time in integer ns). At interfaces the name of a scalar ends in its unit:
// _um _mm _urad _s _hz _V.
#pragma once

#include <cstdint>
#include <numbers>

namespace mdof {

inline constexpr std::int64_t kNsPerS = 1'000'000'000;
inline constexpr double kInch_m = 0.0254;

// The functions divide by an exact power of ten, which is rounded only once. Therefore 200 µm
// converted to m and back is exactly 200 µm.
inline constexpr double from_um(double x_um) {
  return x_um / 1e6;
}
inline constexpr double from_mm(double x_mm) {
  return x_mm / 1e3;
}
inline constexpr double from_urad(double x_urad) {
  return x_urad / 1e6;
}
inline constexpr double to_um(double x_m) {
  return x_m * 1e6;
}
inline constexpr double to_mm(double x_m) {
  return x_m * 1e3;
}
inline constexpr double to_urad(double x_rad) {
  return x_rad * 1e6;
}
inline constexpr double to_deg(double x_rad) {
  return x_rad * (180 / std::numbers::pi);
}
inline constexpr double ns_to_s(std::int64_t t_ns) {
  return static_cast<double>(t_ns) * 1e-9;
}

}  // namespace mdof
