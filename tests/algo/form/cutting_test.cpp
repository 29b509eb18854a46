// Passes of a known repeatable and random share: what is found of them, the next path, the floors.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "algo/form/cutting.h"

namespace mdof::algo {
namespace {

class Cutting : public ::testing::Test {
 protected:
  SurfaceMap map(double scale_m, bool is_random) {
    SurfaceMap result{"m", 0, 0, 1e-3, 1e-3, 60, 40, {}, {}};
    std::normal_distribution<double> normal;
    for (std::size_t j = 0; j < 40; ++j)
      for (std::size_t i = 0; i < 60; ++i)
        result.z_m.push_back(scale_m * (is_random ? normal(engine_)
                                                  : std::sqrt(2) * std::sin(0.3 * double(i)) *
                                                        std::sqrt(2) * std::cos(0.2 * double(j))));
    return result;
  }
  // The machine: what it cuts of a path.
  SurfaceMap cut(const SurfaceMap& path, double response = 1) {
    SurfaceMap result = path;
    const SurfaceMap repeats = map(0.3e-6, false), random = map(kSigma_m, true);
    for (std::size_t k = 0; k < result.z_m.size(); ++k)
      result.z_m[k] = response * result.z_m[k] + repeats.z_m[k] + random.z_m[k];
    return result;
  }
  CuttingResult passes(CuttingGain gain, std::size_t n, double response = 1) {
    CuttingPasses p{map(0.9e-6, false), {}, false, gain};
    SurfaceMap path = p.wanted;
    CuttingResult result;
    for (std::size_t k = 0; k < n; ++k) {
      p.cuts.push_back(cut(path, response));
      result = *next_cut(p);
      path = result.next;
    }
    return result;
  }

  static constexpr double kSigma_m = 0.048e-6;
  std::mt19937 engine_{1};
};

TEST_F(Cutting, SharesOfRepeatedPasses) {
  CuttingPasses p{map(0.9e-6, false), {}, true, CuttingGain::one};
  for (int k = 0; k < 3; ++k) p.cuts.push_back(cut(p.wanted));
  const auto found = next_cut(p);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found->random_rms_m, kSigma_m, 0.02 * kSigma_m);
  EXPECT_NEAR(*found->repeatable_rms_m, 0.3e-6, 0.02e-6);
  EXPECT_NEAR(*found->floor_gain_one_m, 0.0679e-6, 0.0014e-6);
  EXPECT_NEAR(*found->floor_mean_m, 0.0554e-6, 0.0011e-6);
  EXPECT_TRUE(*found->converges);
  // Gain 1: the last error; the mean: of all.
  EXPECT_NEAR(found->next.z_m[77], 2 * p.wanted.z_m[77] - p.cuts[2].z_m[77], 1e-18);
  p.gain = CuttingGain::mean;
  EXPECT_NEAR(
      next_cut(p)->next.z_m[77],
      2 * p.wanted.z_m[77] - (p.cuts[0].z_m[77] + p.cuts[1].z_m[77] + p.cuts[2].z_m[77]) / 3,
      1e-18);
}

// With gain 1 a third pass does not help; the mean of the passes does.
TEST_F(Cutting, FloorsOfPassesThatFollow) {
  const CuttingResult one = passes(CuttingGain::one, 4), mean = passes(CuttingGain::mean, 4);
  EXPECT_NEAR(one.error[0].rms_m, 0.3e-6, 0.02e-6);
  for (std::size_t k = 1; k < 4; ++k) {
    EXPECT_NEAR(one.error[k].rms_m, std::sqrt(2) * kSigma_m, 0.06 * kSigma_m) << k;
    EXPECT_NEAR(mean.error[k].rms_m, kSigma_m * std::sqrt(1 + 1 / double(k)), 0.06 * kSigma_m) << k;
  }
  for (const CuttingResult& r : {one, mean}) {
    EXPECT_NEAR(*r.random_rms_m, kSigma_m, 0.02 * kSigma_m);
    EXPECT_NEAR(*r.repeatable_rms_m, 0.3e-6, 0.02e-6);
    EXPECT_TRUE(*r.converges);
  }
}

TEST_F(Cutting, AMachineThatCutsTooMuchDiverges) {
  EXPECT_TRUE(*passes(CuttingGain::one, 4, 1.3).converges);
  EXPECT_FALSE(*passes(CuttingGain::one, 4, 2.5).converges);
}

TEST_F(Cutting, OnePassTellsNoShares) {
  const CuttingResult found = passes(CuttingGain::mean, 1);
  EXPECT_FALSE(found.random_rms_m || found.converges || found.floor_mean_m);
  EXPECT_EQ(found.pixels, 2400u);
}

}  // namespace
}  // namespace mdof::algo
