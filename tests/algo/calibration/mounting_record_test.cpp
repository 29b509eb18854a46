// Tests the contents of a calibration record and the clampings from which it is calculated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "algo/calibration/mounting.h"
#include "tests/algo/calibration/tilted_target.h"

namespace mdof::algo {
namespace {

Rig rig_of_record() {
  return parse_rig(test::mounting_rig_toml("u_position_mm = 0.05\nu_direction_mrad = 2\n"),
                   "rig_X.toml")
      .value();
}

// Positions of probes are calibrated along X and Y on the top plane, along X and Z on the side
// plane.
TEST(MountingRecord, StatesPositionsAndUncertainties) {
  std::mt19937_64 rng(21);
  test::TiltedTarget target(rng, 50e-6, 0, 3e-6);
  target.clamp(6, 5e-3, rng);
  const Rig rig = rig_of_record();
  const auto fit = fit_mounting(rig, target.logs(rng));
  ASSERT_TRUE(fit) << fit.error().message;
  const MountingCalibration& found = fit->found;
  ASSERT_EQ(found.probes.size(), 5u);
  std::size_t readings = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    const MountedProbe& probe = found.probes[k];
    const auto i = static_cast<Eigen::Index>(6 * k);
    const std::size_t across = k < 3 ? 1 : 2, facing = k < 3 ? 2 : 1;
    EXPECT_EQ(probe.id, rig.probes[k].id);
    EXPECT_NEAR(probe.position_m[0], rig.probes[k].position_m[0] + fit->change(i), 1e-15) << k;
    EXPECT_NEAR(probe.position_m[across], rig.probes[k].position_m[across] + fit->change(i + 1),
                1e-15);
    EXPECT_NEAR(probe.position_m[facing], rig.probes[k].position_m[facing], 1e-15) << k;
    EXPECT_NEAR(probe.zero_m, fit->change(i + 2), 1e-18);
    EXPECT_NEAR(probe.zero_m, target.probes[k].zero, 2e-6);
    EXPECT_EQ(probe.scale_1, 0);
    EXPECT_TRUE(std::isnan(probe.u_scale_1));  // the rig does not declare it
    EXPECT_GT(probe.u_position_m[0], 0);
    EXPECT_GE(probe.u_position_m[0], 0.999 * std::sqrt(fit->covariance(i, i)));
    EXPECT_GE(probe.u_position_m[across], 0.999 * std::sqrt(fit->covariance(i + 1, i + 1)));
    EXPECT_EQ(probe.u_position_m[facing], 0) << k;
    // The clampings do not determine the directions, so the directions of the rig remain.
    EXPECT_EQ(probe.direction, rig.probes[k].direction);
    EXPECT_TRUE(probe.zero_seen);
    EXPECT_LE(probe.readings, 6u * 2 * 5);
    EXPECT_GT(probe.readings, 6u * 5);
    readings += probe.readings;
  }
  EXPECT_EQ(found.readings, readings);
  EXPECT_EQ(found.clampings, 6u);
  // Largest angle between two tilts of the simulated clampings.
  double most = 0;
  for (const auto& a : target.clampings)
    for (const auto& b : target.clampings)
      most = std::max(
          most, std::sqrt(test::dot(test::minus(a.angle, b.angle), test::minus(a.angle, b.angle))));
  EXPECT_NEAR(found.tilt_rad, most, 0.02 * most);
}

// Along X alone, the zeros of B and C (both at x = 0) and the tilt about X have the same effect.
TEST(MountingRecord, KeepsTheZeroOfTheRigIfItIsNotSeen) {
  std::mt19937_64 rng(21);
  test::TiltedTarget target(rng, 50e-6, 0, 3e-6);
  target.clamp(6, 5e-3, rng);
  auto logs = target.logs(rng);
  for (Clamping& clamping : logs)
    std::erase_if(clamping.traverses, [](const Traverse& t) { return t.axis != Axis::x; });
  const auto fit = fit_mounting(rig_of_record(), logs);
  ASSERT_TRUE(fit) << fit.error().message;
  int unseen = 0;
  for (const MountedProbe& probe : fit->found.probes) {
    if (probe.zero_seen) continue;
    EXPECT_EQ(probe.zero_m, 0) << probe.id;
    ++unseen;
  }
  EXPECT_GE(unseen, 2);
}

// The matrix is symmetric. Its diagonal contains the variances of the single quantities of the
// probes.
TEST(MountingRecord, MatrixContainsThePositionUncertainties) {
  std::mt19937_64 rng(22);
  test::TiltedTarget target(rng, 50e-6, 0, 3e-6);
  target.clamp(6, 5e-3, rng);
  const auto fit = fit_mounting(rig_of_record(), target.logs(rng));
  ASSERT_TRUE(fit) << fit.error().message;
  const CalibrationCovariance& covariance = fit->found.covariance;
  // For each probe: two components of the position, and the zero.
  ASSERT_EQ(covariance.of.size(), 5u * 3);
  const auto at = [&](const std::string& name) {
    const auto found = std::find(covariance.of.begin(), covariance.of.end(), name);
    EXPECT_NE(found, covariance.of.end()) << name;
    return static_cast<std::size_t>(found - covariance.of.begin());
  };
  for (std::size_t k = 0; k < 5; ++k) {
    const MountedProbe& probe = fit->found.probes[k];
    for (const std::size_t axis : {std::size_t{0}, k < 3 ? std::size_t{1} : std::size_t{2}}) {
      const std::size_t i = at(place_name(probe.id, axis));
      EXPECT_NEAR(std::sqrt(covariance.m2[i][i]), probe.u_position_m[axis], 1e-12) << k;
    }
    const std::size_t zero = at(zero_name(probe.id));
    EXPECT_NEAR(std::sqrt(covariance.m2[zero][zero]), probe.u_zero_m, 1e-14);
  }
  for (std::size_t i = 0; i < 15; ++i)
    for (std::size_t j = 0; j < 15; ++j) {
      EXPECT_EQ(covariance.m2[i][j], covariance.m2[j][i]);
      EXPECT_LE(std::abs(covariance.m2[i][j]),
                std::sqrt(covariance.m2[i][i] * covariance.m2[j][j]) * (1 + 1e-9));
    }
  // The positions of neighbouring probes are correlated, because the same tilts determine them.
  const std::size_t a = at(place_name("A", 0)), b = at(place_name("B", 0));
  const Eigen::Index ia = 0, ib = 6;
  EXPECT_NEAR(covariance.m2[a][b], fit->covariance(ia, ib), 1e-14);
}

}  // namespace
}  // namespace mdof::algo
