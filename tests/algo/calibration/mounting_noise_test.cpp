// Tests with simulated clampings of known mountings (tilted_target.h). The noise is as large as the
// effects that show the directions of the probes.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/calibration/mounting.h"
#include "tests/algo/calibration/tilted_target.h"

namespace mdof::algo {
namespace {

using test::TiltedTarget;

// A direction has an effect on a reading only by the product travel × tilt × direction: 2 mm × 3
// mrad × 2 mrad = 12 nm. With most of these seeds, Gauss-Newton iterations alone do not converge.
TEST(MountingNoise, FitsNearTheDetectionLimitCoverTheTruth) {
  const Rig rig = parse_rig(test::mounting_rig_toml("", 12000), "rig_X.toml").value();
  int inside = 0, n = 0, seen = 0;
  for (const double noise_m : {9e-9, 18e-9})
    for (const std::uint64_t seed : {2, 12, 15, 17, 21, 80}) {
      std::mt19937_64 rng(seed);
      TiltedTarget target(rng, 50e-6, 0, 3e-6);
      target.noise_m = noise_m;
      target.reach_m = 2e-3;
      target.range_m = 12e-3;
      target.travels = {Axis::x, Axis::y, Axis::z};
      target.clamp(6, 3e-3, rng);
      const auto fit = fit_mounting(rig, target.logs(rng));
      ASSERT_TRUE(fit) << noise_m << ", seed " << seed << ": " << fit.error().message;
      Eigen::VectorXd truth = Eigen::VectorXd::Zero(30);
      for (std::size_t k = 0; k < 5; ++k) {
        const auto i = static_cast<Eigen::Index>(6 * k);
        truth(i) = target.probes[k].place[0] - rig.probes[k].position_m[0];
        truth(i + 1) =
            target.probes[k].place[k < 3 ? 1 : 2] - rig.probes[k].position_m[k < 3 ? 1 : 2];
        truth(i + 2) = target.probes[k].zero;
        seen += fit->found.probes[k].direction_seen;
      }
      const Eigen::VectorXd off = fit->change - fit->seen * truth;
      for (const int i : {0, 1, 6, 7, 12, 13, 18, 19, 24, 25}) {
        inside += std::abs(off(i)) <= 1.96 * std::sqrt(fit->covariance(i, i));
        ++n;
      }
    }
  std::printf("inside %.2f %% of %d, directions seen %d of 60\n", 100.0 * inside / n, n, seen);
  EXPECT_GT(seen, 0);
  EXPECT_LT(seen, 60);
  EXPECT_NEAR(inside / static_cast<double>(n), 0.95, 0.05);
}

}  // namespace
}  // namespace mdof::algo
