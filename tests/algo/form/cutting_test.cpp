// Tests passes with known repeatable and random shares: the estimated shares, the next path, and
// the floors (lowest errors that passes can reach).
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
  // The surface that the machine cuts if it follows a path.
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

TEST_F(Cutting, EstimatesSharesOfRepeatedPasses) {
  CuttingPasses p{map(0.9e-6, false), {}, true, CuttingGain::one};
  for (int k = 0; k < 3; ++k) p.cuts.push_back(cut(p.wanted));
  const auto found = next_cut(p);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found->random_rms_m, kSigma_m, 0.02 * kSigma_m);
  EXPECT_NEAR(*found->repeatable_rms_m, 0.3e-6, 0.02e-6);
  EXPECT_NEAR(*found->floor_gain_one_m, 0.0679e-6, 0.0014e-6);
  EXPECT_NEAR(*found->floor_mean_m, 0.0554e-6, 0.0011e-6);
  EXPECT_TRUE(*found->converges);
  // Gain 1 corrects the last error; the mean gain corrects the mean of all errors.
  EXPECT_NEAR(found->next.z_m[77], 2 * p.wanted.z_m[77] - p.cuts[2].z_m[77], 1e-18);
  p.gain = CuttingGain::mean;
  EXPECT_NEAR(
      next_cut(p)->next.z_m[77],
      2 * p.wanted.z_m[77] - (p.cuts[0].z_m[77] + p.cuts[1].z_m[77] + p.cuts[2].z_m[77]) / 3,
      1e-18);
}

// With gain 1 a third pass does not reduce the error. With the mean of the passes it does.
TEST_F(Cutting, SuccessivePassesReachTheirFloors) {
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

TEST_F(Cutting, ExcessiveResponseDiverges) {
  EXPECT_TRUE(*passes(CuttingGain::one, 4, 1.3).converges);
  EXPECT_FALSE(*passes(CuttingGain::one, 4, 2.5).converges);
}

// A cut with a long wave is measured with noise in each pixel. Gain 1 cuts this noise into the next
// pass. A smoothed correction does not, also at corners and around a hole.
TEST_F(Cutting, SmoothingKeepsPixelNoiseOutOfThePart) {
  const double noise_m = 3e-9;
  const auto wave = [](double i, double j) { return 0.3e-6 * std::sin(0.1 * i + 0.05 * j); };
  CuttingPasses p{map(0, false), {map(noise_m, true)}, false, CuttingGain::one};
  for (std::size_t k = 0; k < 2400; ++k) p.cuts[0].z_m[k] += wave(double(k % 60), double(k / 60));
  for (std::size_t k : {1210u, 1211u, 1270u, 1271u}) p.cuts[0].z_m[k] = SurfaceMap::kMissing;
  const auto second_pass_error = [&] {
    const auto found = next_cut(p);
    SurfaceMap error = found->next;
    for (std::size_t k = 0; k < 2400; ++k) error.z_m[k] += wave(double(k % 60), double(k / 60));
    EXPECT_EQ(error.measured(), 2396u);
    return std::pair{figures_of(error), found->left_by_smoothing_rms_m};
  };
  const auto [raw, nothing] = second_pass_error();
  EXPECT_NEAR(raw.rms_m, noise_m, 0.05 * noise_m);
  EXPECT_FALSE(nothing);
  p.smooth_m = 10e-3;
  const auto [smooth, left] = second_pass_error();
  // The square has 11 x 11 pixels: about 1.9 / 11 of the noise remains in the middle, more at edges
  // and corners.
  EXPECT_LE(smooth.rms_m, 0.33 * noise_m);
  EXPECT_LE(smooth.pv_m, 2.5 * noise_m);
  EXPECT_NEAR(*left, noise_m, 0.05 * noise_m);
  p.smooth_m = 1.9e-3;
  EXPECT_FALSE(next_cut(p));
}

// To first order, smoothing over a square with the side a keeps the share 1 - (pi a / l)^4 / 280 of
// a wave of the length l.
TEST_F(Cutting, SmoothingKeepsLongWaves) {
  CuttingPasses p{map(0, false), {map(0, false)}, false, CuttingGain::one, 20e-3};
  for (std::size_t k = 0; k < 2400; ++k)
    p.cuts[0].z_m[k] = 1e-6 * std::sin(2 * 3.14159265358979 / 50 * double(k % 60) + 1);
  const SurfaceMap next = next_cut(p)->next;
  const std::size_t middle = 20 * 60 + 29;
  // 21 pixels cover 21 mm.
  EXPECT_NEAR(next.z_m[middle] / p.cuts[0].z_m[middle], -(1 - std::pow(3.14159 * 21 / 50, 4) / 280),
              1.2e-3);
}

// The repeatable share and the random share are both 0.08 um. Then the optimal gain leaves less
// error than gain 1. If the random share is much larger, the factor is 0. The piston is always
// corrected.
TEST_F(Cutting, OptimalGainLeavesTheSmallestError) {
  const SurfaceMap repeats = map(0.08e-6, false), first = map(0.08e-6, true);
  CuttingPasses p{map(0, false), {first}, false, CuttingGain::optimal, 0, 0.08e-6};
  for (std::size_t k = 0; k < 2400; ++k) p.cuts[0].z_m[k] += repeats.z_m[k] + 1e-6;
  const auto next_pass_error = [&] {
    SurfaceMap error = next_cut(p)->next;
    for (std::size_t k = 0; k < 2400; ++k) error.z_m[k] += repeats.z_m[k];
    return figures_of(error);
  };
  EXPECT_NEAR(*next_cut(p)->factor, 0.5, 0.03);
  EXPECT_NEAR(next_pass_error().rms_m, 0.08e-6 * std::sqrt(0.5), 0.003e-6);
  EXPECT_NEAR(next_pass_error().mean_m, -1e-6, 0.01e-6);
  p.gain = CuttingGain::one;
  EXPECT_NEAR(next_pass_error().rms_m, 0.08e-6, 0.003e-6);
  p.gain = CuttingGain::optimal;
  p.random_rms_m = 1e-6;
  EXPECT_EQ(*next_cut(p)->factor, 0);
  p.random_rms_m.reset();
  EXPECT_FALSE(next_cut(p));
}

// Repeated passes show the random share, so the request need not state it.
TEST_F(Cutting, FindsTheOptimalGainOfRepeatedPasses) {
  const SurfaceMap repeats = map(0.1e-6, false);
  CuttingPasses p{map(0, false), {}, true, CuttingGain::optimal};
  for (int k = 0; k < 3; ++k) p.cuts.push_back(map(0.1e-6, true));
  for (SurfaceMap& cut : p.cuts)
    for (std::size_t k = 0; k < 2400; ++k) cut.z_m[k] += repeats.z_m[k];
  const auto found = next_cut(p);
  EXPECT_NEAR(*found->factor, 0.75, 0.03);  // 1 / (1 + 1 / 3)
  EXPECT_NEAR(*found->floor_optimal_m, 0.1e-6 * std::sqrt(1.25), 0.003e-6);
}

// The shares are also found if the paths of the passes were smoothed.
TEST_F(Cutting, EstimatesSharesOfSmoothedPasses) {
  CuttingPasses p{map(0.9e-6, false), {}, false, CuttingGain::one, 6e-3};
  SurfaceMap path = p.wanted;
  CuttingResult result;
  for (std::size_t k = 0; k < 3; ++k) {
    p.cuts.push_back(cut(path));
    result = *next_cut(p);
    path = result.next;
  }
  EXPECT_NEAR(*result.random_rms_m, kSigma_m, 0.03 * kSigma_m);
  EXPECT_NEAR(*result.repeatable_rms_m, 0.3e-6, 0.02e-6);
}

// The passes have no error, so repeated and successive passes converge.
TEST_F(Cutting, PassesWithoutErrorConverge) {
  for (const bool repeated : {false, true})
    for (const CuttingGain gain : {CuttingGain::one, CuttingGain::mean}) {
      const SurfaceMap wanted = map(0.9e-6, false);
      const auto found = next_cut({wanted, {wanted, wanted, wanted}, repeated, gain, 0});
      ASSERT_TRUE(found);
      EXPECT_TRUE(found->converges.value_or(false)) << repeated;
    }
}

TEST_F(Cutting, SinglePassGivesNoShares) {
  const CuttingResult found = passes(CuttingGain::mean, 1);
  EXPECT_FALSE(found.random_rms_m || found.converges || found.floor_mean_m);
  EXPECT_EQ(found.pixels, 2400u);
}

}  // namespace
}  // namespace mdof::algo
