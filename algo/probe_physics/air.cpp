#include "algo/probe_physics/air.h"

namespace mdof::algo {
namespace {

constexpr double kZeroCelsius_K = 273.15, kHPaPerKPa = 10;
// Difference of a quantity for the calculation of the slope. It is small enough, because the slope
// changes by 1e-2 of its value per unit.
constexpr double kStep = 0.01;

// Saturation vapour pressure of water, hPa at t in °C; -50 to 50 °C. With a polynomial, the result
// is identical to the last bit on every machine.
double saturation_hPa(double t) {
  return 6.107799961 +
         t * (4.436518521e-1 +
              t * (1.428945805e-2 +
                   t * (2.650648471e-4 +
                        t * (3.031240396e-6 + t * (2.034080948e-8 + t * 6.136820929e-11)))));
}

}  // namespace

double air_permittivity(const Air& air) {
  const auto& [temperature_C, pressure_kPa, humidity_percent] = air;
  const double T_K = temperature_C + kZeroCelsius_K;
  const double vapour_hPa = humidity_percent / 100 * saturation_hPa(temperature_C);
  const double refractivity_ppm =
      77.6 * kHPaPerKPa * pressure_kPa / T_K + 3.73e5 * vapour_hPa / (T_K * T_K);
  return 1 + 2e-6 * refractivity_ppm;
}

double air_permittivity_slope(const Air& air, std::size_t quantity) {
  Air above = air, below = air;
  above[quantity] += kStep;
  below[quantity] -= kStep;
  return (air_permittivity(above) - air_permittivity(below)) / (2 * kStep);
}

}  // namespace mdof::algo
