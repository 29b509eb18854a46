// The permittivity of the air between a capacitance probe and its target.
#pragma once

#include "schema/rig/effects/physics.h"

namespace mdof::algo {

// ε_r of moist air. ε_r - 1 = 2 (n - 1), with the refractive index n by Smith and Weintraub (1953):
// 10^6 (n - 1) = 77.6 p/T + 3.73e5 e/T². Pressure p and vapour pressure e are in hPa, T in K; the
// formula is accurate to 0.5 % of n - 1. e = humidity · e_s(t). The saturation pressure e_s is from
// Lowe's polynomial (1977, over water).
double air_permittivity(const Air& air);

// Returns the change of the permittivity per unit of air_quantities()[quantity]: per °C, kPa or %.
double air_permittivity_slope(const Air& air, std::size_t quantity);

}  // namespace mdof::algo
