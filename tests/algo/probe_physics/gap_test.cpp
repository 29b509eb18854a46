// Tests the permittivity of air and the effect of tilted targets. Expected: published values, and
// the numerical integral over a tilted disc.
#include "algo/probe_physics/gap.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/probe_physics/air.h"

namespace mdof::algo {
namespace {

constexpr Air kDry = {20, 101.325, 0};

ProbePhysics electrode(double radius_m, double factor) {
  ProbePhysics physics;
  physics.sensing_radius_m = radius_m;
  physics.tilt_factor = factor;
  return physics;
}

// The gap that a probe without fringing field indicates over a tilted target: A / ∫ dA/(d + ρ θ cos
// φ) with the area A, the gap d, the tilt θ and polar coordinates ρ, φ. The integral over rings and
// angles is calculated by the midpoint rule.
double indicated_gap_of_disc_m(double radius_m, double gap_m, double tilt_rad) {
  constexpr int kRings = 400, kAngles = 400;
  double sum = 0;
  for (int i = 0; i < kRings; ++i) {
    const double rho_m = radius_m * (i + 0.5) / kRings;
    for (int j = 0; j < kAngles; ++j) {
      const double angle = 2 * 3.14159265358979 * (j + 0.5) / kAngles;
      sum += rho_m / (gap_m + rho_m * tilt_rad * std::cos(angle));
    }
  }
  const double area = radius_m * kRings / 2, integral = sum / kAngles;
  return area / integral;
}

TEST(ProbeGap, TiltExcessMatchesPublishedValues) {
  const auto excess_m = [](double r_mm, double d_mm, double mrad) {
    return gap_decrease_by_tilt_m(electrode(r_mm * 1e-3, 5), mrad * mrad * 1e-6, d_mm * 1e-3);
  };
  EXPECT_NEAR(excess_m(0.5, 0.25, 0.2) * 1e9, 0.05, 5e-4);
  EXPECT_NEAR(excess_m(3, 0.75, 30) * 1e6, 13.5, 0.005);
  EXPECT_NEAR(excess_m(2, 0.25, 1) * 1e9, 20, 0.005);
}

TEST(ProbeGap, TiltFactorOfAnIdealDiscIsOne) {
  for (const double tilt_rad : {0.5e-3, 2e-3, 10e-3}) {
    const double d_m = 250e-6, r_m = 2e-3, shown_m = indicated_gap_of_disc_m(r_m, d_m, tilt_rad);
    EXPECT_LT(shown_m, d_m) << "a tilted target seems nearer";
    const double excess_m = gap_decrease_by_tilt_m(electrode(r_m, 1), tilt_rad * tilt_rad, d_m);
    const double share = r_m * tilt_rad / d_m;
    EXPECT_NEAR((d_m - shown_m) / excess_m, 1, share * share / 3 + 1e-3);
    const double found_m = true_gap_m(electrode(r_m, 1), shown_m, tilt_rad * tilt_rad, 1);
    EXPECT_LT(std::abs(found_m - d_m), (d_m - shown_m) * (share * share / 3 + 1e-3));
  }
}

TEST(ProbeGap, GapIsCalculatedBackFromTheReading) {
  const ProbePhysics physics = electrode(2e-3, 5);
  for (const double d_m : {60e-6, 250e-6, 900e-6})
    for (const double tilt_rad : {0.0, 1e-3, 20e-3})
      for (const double ratio : {0.9999, 1.0, 1.0003}) {
        const double shown_m =
            (d_m - gap_decrease_by_tilt_m(physics, tilt_rad * tilt_rad, d_m)) / ratio;
        if (shown_m <= 0) continue;
        EXPECT_NEAR(true_gap_m(physics, shown_m, tilt_rad * tilt_rad, ratio), d_m, 1e-16);
      }
}

TEST(ProbeGap, DetectsAnElectrodeThatTouches) {
  const ProbePhysics physics = electrode(2e-3, 5);
  EXPECT_FALSE(touches(physics, 0.0999 * 0.0999, 200e-6));
  EXPECT_TRUE(touches(physics, 0.1001 * 0.1001, 200e-6));
  EXPECT_TRUE(touches(physics, 0, 0));
  EXPECT_TRUE(touches(physics, 0, -1e-6));
  EXPECT_TRUE(touches(physics, 0, std::nan("")));
}

TEST(ProbeAir, PermittivityMatchesPublishedValues) {
  EXPECT_NEAR((air_permittivity(kDry) - 1) * 1e6, 537, 1);
  EXPECT_NEAR(air_permittivity_slope(kDry, 0) * 1e6, -1.8, 0.05);
  EXPECT_NEAR(air_permittivity_slope(kDry, 1) * 1e6, 5.3, 0.05);
  EXPECT_NEAR(air_permittivity_slope(kDry, 2) * 1e6, 2.0, 0.05);
  // The vapour pressure from another source: Magnus (WMO), 6.112 exp(17.62 t/(243.12 + t)) hPa.
  for (const double t : {0.0, 10.0, 25.0, 40.0}) {
    const double e_hPa = 6.112 * std::exp(17.62 * t / (243.12 + t)), T_K = t + 273.15;
    const double damp = air_permittivity({t, 100, 100}) - air_permittivity({t, 100, 0});
    EXPECT_NEAR(damp / (2e-6 * 3.73e5 * e_hPa / (T_K * T_K)), 1, 3e-3) << t;
  }
}

TEST(ProbeAir, HumidityOf20PercentChangesTheGapBy10nm) {
  const double ratio = air_permittivity({20, 101.325, 60}) / air_permittivity({20, 101.325, 40});
  const double gap_m = 250e-6, shown_m = gap_m / ratio;
  EXPECT_NEAR((gap_m - shown_m) * 1e9, 10, 0.3);
  EXPECT_NEAR(true_gap_m(electrode(0, 5), shown_m, 0, ratio), gap_m, 1e-16);
}

}  // namespace
}  // namespace mdof::algo
