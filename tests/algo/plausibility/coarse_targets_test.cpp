#include "algo/plausibility/coarse_targets.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algo/rigs.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

// A run of X whose EYX is a wave of `steps` intervals of 5 mm, and whose other errors are a bow.
mdof::Run wave(double steps, int targets = 11, double noise_m = 1e-10) {
  mdof::Run run;
  run.header.axis = Axis::x;
  for (const int direction : {1, -1})
    for (int i = 0; i < targets; ++i) {
      MeasuredPoint& p = run.points.emplace_back();
      p.target = i + 1;
      p.point.direction = direction;
      p.point.position_m = i * 5e-3;
      p.errors.valid = true;
      p.errors.local.fill(1e-7 * i * i);
      p.errors.local[kDy] = 3e-6 * std::sin(2 * M_PI * i / steps + 0.4);
      for (std::size_t e = 0; e < kErrorCount; ++e) p.errors.covariance[6 * e] = noise_m * noise_m;
    }
  return run;
}

Rig rig(double u_encoder_m) {
  Rig rig = test::rig_x();
  rig.uncertainty.encoder.u = u_encoder_m;
  return rig;
}

TEST(CoarseTargets, AreReportedForWavesOfFewIntervals) {
  for (const double steps : {2.2, 2.5, 3.0})
    EXPECT_EQ(test::shown(coarse_target_notices(rig(5e-7), wave(steps))),
              "targets_too_coarse errors=EYX\n")
        << steps;
  for (const double steps : {4.0, 6.0, 20.0})
    EXPECT_TRUE(coarse_target_notices(rig(5e-7), wave(steps)).empty()) << steps;
}

TEST(CoarseTargets, MatterOnlyIfUContainsThem) {
  EXPECT_TRUE(coarse_target_notices(rig(0), wave(2.5)).empty());
  // The slope of this wave is 1.5 mrad: 0.8 nm with u of the encoder.
  EXPECT_FALSE(coarse_target_notices(rig(5e-7), wave(2.5, 11, 3e-10)).empty());
  EXPECT_TRUE(coarse_target_notices(rig(5e-7), wave(2.5, 11, 3e-9)).empty());
  Rig scale = rig(0);
  scale.expansion.scale.u_temperature.u = 2;
  scale.expansion.scale.expansion.per_K = 1e-5;
  EXPECT_EQ(coarse_target_notices(scale, wave(2.5)).size(), 1U);
}

TEST(CoarseTargets, AreUnknownForFewTargets) {
  EXPECT_TRUE(coarse_target_notices(rig(5e-7), wave(2.5, 4)).empty());
  EXPECT_TRUE(coarse_target_notices(rig(5e-7), mdof::Run()).empty());
}

}  // namespace
}  // namespace mdof::algo
