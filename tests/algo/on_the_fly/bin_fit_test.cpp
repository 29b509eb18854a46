#include "algo/on_the_fly/bin_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

struct BinReadings {
  std::vector<double> place, reading, scratch;
  template <class Curve>
  BinReadings(int n, Curve curve, double from = -1, double to = 1) {
    for (int i = 0; i < n; ++i) {
      place.push_back(from + (to - from) * (i + 0.3) / n);
      reading.push_back(curve(place.back()));
    }
  }
  BinFit fit() { return fit_bin(place, reading, 5e-8, scratch); }
};

TEST(BinFit, IsExactForAnAsymmetricParabola) {
  BinReadings bin(
      40, [](double x) { return 2e-6 + 3e-6 * x - 4e-7 * x * x; }, -0.9, 0.5);
  const auto found = bin.fit();
  EXPECT_NEAR(found.value, 2e-6, 1e-18);
  EXPECT_NEAR(found.slope, 3e-6, 1e-17);
  EXPECT_EQ(found.rejected, 0U);
}

TEST(BinFit, ReducesAWaveByTheStatedShare) {
  // The parabola changes the amplitude of a wave with a length of 5 bins by the share (pi / 5)^4 /
  // 280.
  const double turn = std::acos(-1.0) / 5;
  BinReadings top(4001, [=](double x) { return 1e-6 * std::cos(turn * x); });
  EXPECT_NEAR(top.fit().value - 1e-6, -1e-6 * std::pow(turn, 4) / 280, 3e-11);
  BinReadings side(4001, [=](double x) { return 1e-6 * std::sin(turn * x); });
  EXPECT_NEAR(side.fit().slope / (1e-6 * turn), 1, 3e-3);
}

TEST(BinFit, RejectsSpikes) {
  for (const int at : {0, 1, 13, 39}) {
    BinReadings bin(40, [](double x) { return 1e-6 * x; });
    bin.reading[static_cast<std::size_t>(at)] += 5e-6;
    const auto found = bin.fit();
    EXPECT_EQ(found.rejected, 1U) << at;
    EXPECT_NEAR(found.value, 0, 1e-15) << at;
  }
}

// Three of five neighbours are spikes, so the median of the five is a spike. The result must equal
// the fit without the spikes.
TEST(BinFit, RejectsAdjacentSpikes) {
  const auto wave = [](double x) { return 1e-6 * x + 3e-7 * x * x; };
  for (const double height_m : {50e-6, -50e-6})
    for (const std::vector<std::size_t>& at : {std::vector<std::size_t>{10, 11, 13},
                                               {3, 5, 6, 20},
                                               {0, 1, 2, 20},
                                               {17, 37, 38, 39},
                                               {20, 21, 22}}) {
      std::mt19937_64 random(3);
      BinReadings bin(40, wave), without(40, wave);
      for (std::size_t i = 0; i < 40; ++i)
        bin.reading[i] += 4e-9 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
      without.reading = bin.reading;
      for (auto i = at.rbegin(); i != at.rend(); ++i) {
        bin.reading[*i] += height_m;
        without.reading.erase(without.reading.begin() + static_cast<std::ptrdiff_t>(*i));
        without.place.erase(without.place.begin() + static_cast<std::ptrdiff_t>(*i));
      }
      const auto found = bin.fit();
      EXPECT_LE(found.used, 40 - at.size());
      EXPECT_GE(found.used, 40 - 2 * at.size());
      EXPECT_NEAR(found.value, without.fit().value, 1e-9) << height_m << " at " << at[0];
      EXPECT_LT(found.sd, 2e-9);
    }
}

// Neither a step nor a form that deviates far from a straight line contains spikes.
TEST(BinFit, RejectsNothingAtAStep) {
  for (const double from : {-0.8, -0.5, 0.0, 0.5, 0.8}) {
    BinReadings bin(40, [=](double x) { return x > from ? 3e-7 : 0; });
    EXPECT_EQ(bin.fit().rejected, 0U) << from;
  }
  BinReadings bend(40, [](double x) { return 2e-7 * x * x * x * x; });
  EXPECT_EQ(bend.fit().rejected, 0U);
}

TEST(BinFit, StatesTheScatterOfItsValue) {
  std::mt19937_64 random(5);
  double square = 0, u_square = 0;
  constexpr int kBins = 400;
  for (int k = 0; k < kBins; ++k) {
    BinReadings bin(50, [&](double) {  // uniform with sd 1e-8; the same numbers in every library
      return 1e-8 * std::sqrt(12.0) * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5);
    });
    const auto found = bin.fit();
    square += found.value * found.value;
    u_square += found.u * found.u;
  }
  EXPECT_NEAR(std::sqrt(square / kBins), 1.5e-8 / std::sqrt(50.0), 1.5e-10);
  EXPECT_NEAR(std::sqrt(u_square / square), 1.1, 0.12);  // u is at least the u of white noise
}

TEST(BinFit, NeedsEightReadings) {
  BinReadings few(7, [](double x) { return x; });
  EXPECT_EQ(few.fit().used, 7U);
  EXPECT_EQ(few.fit().value, 0);
}

// The readings have no pattern. The expected parabola is calculated by the Gram-Schmidt method. The
// standard deviation of its residuals has n - 3 degrees of freedom.
TEST(BinFit, MatchesTheLeastSquaresParabolaAndItsScatter) {
  std::mt19937_64 random(11);
  for (const int n : {8, 9, 23}) {
    BinReadings bin(n, [&](double x) {
      return 1e-8 * (static_cast<double>(random() >> 11) * 0x1p-53 - 0.5) + 2e-8 * x * x;
    });
    const auto found = fit_bin(bin.place, bin.reading, 1e-6, bin.scratch);  // no reading is a spike
    const auto count = static_cast<std::size_t>(n);
    ASSERT_EQ(found.used, count);
    // The columns x², x and 1. Each column is made orthogonal to the columns before it.
    std::vector<std::vector<double>> q(3, std::vector<double>(count));
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t k = 0; k < 3; ++k)
        q[k][i] = std::pow(bin.place[i], 2 - static_cast<double>(k));
    std::vector<double> left = bin.reading;
    double value = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      for (std::size_t j = 0; j < k; ++j) {
        double part = 0, square = 0;
        for (std::size_t i = 0; i < count; ++i)
          part += q[j][i] * q[k][i], square += q[j][i] * q[j][i];
        for (std::size_t i = 0; i < count; ++i) q[k][i] -= part / square * q[j][i];
      }
      double part = 0, square = 0;
      for (std::size_t i = 0; i < count; ++i)
        part += q[k][i] * left[i], square += q[k][i] * q[k][i];
      value = part / square;  // coefficient of the last column, the constant
      for (std::size_t i = 0; i < count; ++i) left[i] -= value * q[k][i];
    }
    double square = 0;
    for (const double x : left) square += x * x;
    EXPECT_NEAR(found.value, value, 1e-18) << n;
    EXPECT_NEAR(found.sd, std::sqrt(square / (n - 3)), 1e-18) << n;
  }
}

// For fewer than eight readings, the result contains only the number of readings.
TEST(BinFit, IsEmptyForFewerThanEightReadings) {
  BinReadings few(7, [](double x) { return 1e-6 + 1e-6 * x; });
  const auto none = few.fit();
  EXPECT_EQ(none.used, 7u);
  EXPECT_EQ(none.rejected, 0u);
  EXPECT_EQ(none.value, 0);
  EXPECT_EQ(none.slope, 0);
  EXPECT_EQ(none.sd, 0);
  EXPECT_EQ(none.u, 0);
  BinReadings enough(8, [](double x) { return 1e-6 + 1e-6 * x; });
  EXPECT_NEAR(enough.fit().value, 1e-6, 1e-18);
}

// A spike between equal neighbours deviates from their median by its full height; the limit is 50
// nm. The two readings at each end have neighbours on one side only, so their limit is twice as
// high.
TEST(BinFit, SpikeLimitIsTwiceAsHighAtTheEnds) {
  constexpr int kReadings = 21;
  for (int at = 0; at < kReadings; ++at) {
    const bool is_end = at < 2 || at >= kReadings - 2;
    for (const double height_m : {45e-9, 55e-9, 95e-9, 105e-9})
      for (const double sign : {1.0, -1.0}) {
        BinReadings bin(kReadings, [](double) { return 3e-6; });
        bin.reading[static_cast<std::size_t>(at)] += sign * height_m;
        const BinFit found = bin.fit();
        const bool is_spike = height_m > (is_end ? 100e-9 : 50e-9);
        EXPECT_EQ(found.rejected, is_spike ? 1U : 0U) << at << " " << height_m;
        EXPECT_EQ(found.used, is_spike ? 20U : 21U);
        EXPECT_TRUE(!is_spike || std::abs(found.value - 3e-6) < 1e-18);
      }
  }
}

// Both halves of the readings have the same positions, so they determine no slope. The value is the
// mean of the readings.
TEST(BinFit, HasNoSlopeIfBothHalvesHaveTheSamePositions) {
  BinFit found;
  std::vector<double> place, reading, scratch;
  for (int i = 0; i < 20; ++i) {
    place.push_back((i % 2 == 0 ? 0.5 : -0.5) * (i % 5 + 1) / 5);
    reading.push_back(2e-6 + (i == 7 ? 1e-6 : 0));
  }
  std::vector<double> first(place.begin(), place.begin() + 10),
      last(place.begin() + 10, place.end());
  std::sort(first.begin(), first.end());
  std::sort(last.begin(), last.end());
  ASSERT_EQ(first, last);
  found = fit_bin(place, reading, 5e-8, scratch);
  EXPECT_EQ(found.rejected, 1U);
  EXPECT_NEAR(found.value, 2e-6, 1e-15);
}

}  // namespace
}  // namespace mdof::algo
