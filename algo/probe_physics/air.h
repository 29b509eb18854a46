// The permittivity of the air between a capacitance probe and its target.
#pragma once

#include "schema/rig/effects/physics.h"

namespace mdof::algo {

// ε_r of moist air. ε_r - 1 = 2 (n - 1) with the refractivity of Smith and Weintraub (1953), 10^6
// (n - 1) = 77.6 p/T + 3.73e5 e/T² (p, e in hPa, T in K; accurate to 0.5 % of n - 1). The vapour
// pressure is e = humidity · e_s(t), with e_s by Lowe's polynomial (1977, over water).
double air_permittivity(const Air& air);

// Change of the permittivity per °C, kPa or % of air_quantities()[quantity].
double air_permittivity_slope(const Air& air, std::size_t quantity);

}  // namespace mdof::algo
