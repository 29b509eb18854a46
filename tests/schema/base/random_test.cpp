#include "schema/base/random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace mdof {
namespace {

// Source: Random123, tests/kat_vectors. The inputs are zeros, ones and the digits of pi.
TEST(Random, PhiloxMatchesThePublishedAnswers) {
  EXPECT_EQ(philox({0, 0, 0, 0}, 0), (Philox{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox({~0u, ~0u, ~0u, ~0u}, ~0ull),
            (Philox{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, 0x299f31d0a4093822),
            (Philox{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Random, SineMatchesTheLibraryToRounding) {
  for (int i = -100'000; i <= 100'000; ++i) {
    const double turns = i * 3.7e-5;
    EXPECT_NEAR(sine_of_turns(turns), std::sin(2 * M_PI * turns), 3e-15) << turns;
  }
  EXPECT_EQ(sine_of_turns(0), 0);
  EXPECT_NEAR(sine_of_turns(0.25), 1, 2e-16);
  EXPECT_NEAR(sine_of_turns(-0.25), -1, 2e-16);
}

TEST(Random, GaussianInvertsTheDistributionOutToEightSigma) {
  for (int i = -800; i <= 500; ++i) {
    const double x = i * 0.01;
    const double p = std::erfc(-x / std::sqrt(2.0)) / 2;
    EXPECT_NEAR(gaussian(p), x, 1e-9) << x;
  }
  EXPECT_NEAR(gaussian(0.975), 1.959963984540054, 1e-14);
  EXPECT_GT(uniform(0, 0), 0);
  EXPECT_LT(uniform(~0u, ~0u), 1);
}

// Arrays of different lengths. Their probabilities include values near 0 and near 1.
TEST(Random, ArrayOfGaussiansEqualsSingleGaussians) {
  for (const std::size_t n : {0u, 1u, 63u, 64u, 65u, 20'001u}) {
    std::vector<double> p(n);
    for (std::size_t i = 0; i < n; ++i) {
      const Philox words = philox({static_cast<std::uint32_t>(i), 0, 0, 0}, n);
      p[i] = uniform(words[0], words[1]);
      if (i % 100 == 7) p[i] *= 1e-12;
      if (i % 100 == 8) p[i] = i % 200 == 8 ? 0.075 : 0.925;
    }
    std::vector<double> together = p;
    gaussians(together);
    for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(together[i], gaussian(p[i])) << n << " " << p[i];
  }
}

}  // namespace
}  // namespace mdof
