#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "algo/sensitivity/kernels/circle_kernel.h"
#include "algo/sensitivity/random.h"

namespace mdof::algo {
namespace {

constexpr Stream kStream = {0x299f31d0a4093822, 1};

// The known answer test of Random123 whose counter consists of the digits of π. Its words are
// d16cfe09 94fdcceb 5001e420 24126ea1; they are converted to draws.
TEST(SensitivityRandom, DrawsMatchThePublishedBlock) {
  const Stream stream = {0x299f31d0a4093822, 0x03707344};
  const std::uint64_t trial = 0x85a308d3'243f6a88;
  const std::uint64_t q = 2 * std::uint64_t{0x13198a2e};
  EXPECT_EQ(draw(stream, trial, q),
            (static_cast<double>(0xd16cfe09'94fdccebull >> 12) + 0.5) * 0x1p-52);
  EXPECT_EQ(draw(stream, trial, q + 1),
            (static_cast<double>(0x5001e420'24126ea1ull >> 12) + 0.5) * 0x1p-52);
}

TEST(SensitivityRandom, EveryInstructionSetGivesTheScalarBits) {
  for (const InstructionSet set : available_instruction_sets()) {
    for (const std::uint64_t first : {0ull, 4294967290ull, 0xFFFFFFFF'00000000ull}) {
      for (const std::uint64_t step : {1ull, 20ull, 5'000'000'001ull}) {
        for (const std::uint64_t q : {0ull, 7ull, 1000ull}) {
          std::vector<double> x(517);  // no multiple of a vector, more than one inner batch
          draws(kStream, q, first, step, x, set);
          for (std::size_t j = 0; j < x.size(); ++j) {
            ASSERT_EQ(x[j], draw(kStream, first + step * j, q))
                << to_string(set) << ' ' << first << ' ' << step << ' ' << q << ' ' << j;
          }
        }
      }
    }
  }
}

TEST(SensitivityRandom, PairIsTwoDraws) {
  std::vector<double> even(100), odd(100);
  draw_pairs(kStream, 3, 10, 2, even, odd);
  for (std::size_t j = 0; j < even.size(); ++j) {
    EXPECT_EQ(even[j], draw(kStream, 10 + 2 * j, 6));
    EXPECT_EQ(odd[j], draw(kStream, 10 + 2 * j, 7));
  }
}

// The draws must have the mean 1/2 and the variance 1/12. Draws, trials, streams and seeds must not
// be correlated.
TEST(SensitivityRandom, DrawsAreUniformAndUncorrelated) {
  constexpr std::size_t kN = 200'000;
  const auto column = [](Stream stream, std::uint64_t q, std::uint64_t first) {
    std::vector<double> x(kN);
    draws(stream, q, first, 1, x);
    return x;
  };
  const std::vector<double> x = column({1, 0}, 0, 0);
  double mean = 0, square = 0;
  for (const double u : x) {
    mean += u / kN;
    square += (u - 0.5) * (u - 0.5) / kN;
  }
  EXPECT_NEAR(mean, 0.5, 5 * std::sqrt(1 / 12.0 / kN));
  EXPECT_NEAR(square, 1 / 12.0, 5 * std::sqrt((1 / 80.0 - 1 / 144.0) / kN));
  for (const auto& other : {column({1, 0}, 1, 0), column({1, 0}, 2, 0), column({1, 0}, 0, 1),
                            column({1, 1}, 0, 0), column({2, 0}, 0, 0)}) {
    double product = 0;
    for (std::size_t i = 0; i < kN; ++i) product += (x[i] - 0.5) * (other[i] - 0.5) / kN;
    EXPECT_NEAR(product, 0, 5 / 12.0 / std::sqrt(kN));
  }
}

TEST(SensitivityCircle, CosineAndSineAreExactToRounding) {
  double worst = 0;
  for (int i = 0; i <= 1'000'000; ++i) {
    const double turns = i == 1'000'000 ? 1 - 0x1p-53 : draw(kStream, i, 0);
    const CirclePoint at = circle_point(broadcast(turns));
    const long double angle = 2 * 3.14159265358979323846264338327950288L * turns;
    worst = std::max(worst, static_cast<double>(std::abs(std::cos(angle) - at.cosine[0])));
    worst = std::max(worst, static_cast<double>(std::abs(std::sin(angle) - at.sine[0])));
  }
  EXPECT_LT(worst, 2.5e-16);
}

}  // namespace
}  // namespace mdof::algo
