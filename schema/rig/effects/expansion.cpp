#include "schema/rig/effects/expansion.h"

#include <string>

namespace mdof {
namespace {

constexpr double kReference_C = 20;   // standard reference temperature (ISO 1)
constexpr double kMostAbove_K = 100;  // higher temperatures are typing errors
constexpr double kMostGradient_K_per_m = 1000;
constexpr double kMostPpmPerK = 1000;  // ten times the expansion of plastics

ThermalExpansion expansion_of(TomlTable& table, const std::string& body) {
  const std::string key = body + "_ppm_per_K", u_key = "u_" + key;
  const double ppm = table.number(key), u_ppm = table.number(u_key, 0.0);
  if (!(std::abs(ppm) <= kMostPpmPerK))
    table.reject(
        key, "must be the coefficient of expansion in 1e-6/K, from -1000 to 1000 (steel: 11.5)");
  if (!(u_ppm >= 0 && u_ppm <= kMostPpmPerK))
    table.reject(u_key, "must be a standard uncertainty from 0 to 1000");
  return {ppm * 1e-6, u_ppm * 1e-6};
}

// Whether the expansion coefficient must be read: it is given, or a temperature requires it
// (`counts`).
bool requires_expansion(TomlTable& table, const std::string& body, bool counts) {
  return counts || table.has(body + "_ppm_per_K") || table.has("u_" + body + "_ppm_per_K");
}

BodyExpansion body_of(TomlTable& table, const std::string& body) {
  BodyExpansion out;
  const std::string key = body + "_C";
  out.above_20_K = table.number(key, kReference_C) - kReference_C;
  if (!(std::abs(out.above_20_K) <= kMostAbove_K))
    table.reject(key, "must be a temperature in degrees Celsius, from -80 to 120");
  out.u_temperature = read_uncertainty(table, "u_" + body + "_K", 1, kMostAbove_K);
  if (requires_expansion(table, body, out.above_20_K != 0 || out.u_temperature.declared()))
    out.expansion = expansion_of(table, body);
  return out;
}

}  // namespace

RigExpansion read_expansion(TomlTable& table) {
  RigExpansion out;
  auto temperature = table.table("temperature");
  if (!temperature) return out;
  out.any = true;
  out.scale = body_of(*temperature, "scale");
  out.fixture = body_of(*temperature, "fixture");
  out.square_gradient =
      read_uncertainty3(*temperature, "u_square_gradient_K_per_m", 1, kMostGradient_K_per_m);
  if (requires_expansion(*temperature, "square", out.square_gradient.declared()))
    out.square = expansion_of(*temperature, "square");
  return out;
}

}  // namespace mdof
