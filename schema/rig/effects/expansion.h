// Thermal expansion during a run, as a rig declares it. The results refer to lengths at 20 °C.
//
//   [temperature]
//   scale_C = 22                     temperature of the encoder's scale during the run; default 20
//   u_scale_K = 0.5                  standard uncertainty of scale_C
//   scale_ppm_per_K = 10.6           expansion coefficient of the scale
//   u_scale_ppm_per_K = 0.5          standard uncertainty of scale_ppm_per_K
//   fixture_C, u_fixture_K, fixture_ppm_per_K, u_fixture_ppm_per_K      the same for the fixture
//   square_ppm_per_K, u_square_ppm_per_K                                the same for the target
//   u_square_gradient_K_per_m = 0.5  u of the target's temperature gradient along X, Y and Z
//
// Nothing is corrected. A target of uniform temperature keeps its angles and stays flat, and the
// zero of the probes includes the size of the target. Therefore only a temperature gradient of the
// target has an effect.
#pragma once

#include <cmath>

#include "schema/base/toml/toml_reader.h"
#include "schema/rig/uncertainty.h"

namespace mdof {

struct ThermalExpansion {
  double per_K = 0, u_per_K = 0;
  double mean_square_per_K2() const { return per_K * per_K + u_per_K * u_per_K; }
};

struct BodyExpansion {
  ThermalExpansion expansion;
  double above_20_K = 0;
  DeclaredUncertainty u_temperature;  // K
  // Root mean square (about 0, not about the mean) of the relative expansion; the coefficient and
  // the temperature are independent. Because nothing is corrected, it includes both the known
  // expansion and its uncertainty (GUM H.1.7 with its second-order term).
  double relative() const {
    const double above = above_20_K, u = u_temperature.u;
    return std::sqrt(expansion.mean_square_per_K2() * (above * above + u * u));
  }
};

struct RigExpansion {
  bool any = false;  // true: there is a table [temperature]
  BodyExpansion scale, fixture;
  ThermalExpansion square;
  DeclaredUncertainty3 square_gradient;  // temperature gradient of the target; K/m
};

RigExpansion read_expansion(TomlTable& table);

}  // namespace mdof
