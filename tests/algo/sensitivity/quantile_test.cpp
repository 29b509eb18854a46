// Tests the histogram of a study with values calculated by hand: the range of its core, and the
// counts of trials beyond the core.
#include "algo/sensitivity/statistics/quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace mdof::algo {
namespace {

// The core is twice as wide as the interval of the central 98 % of the values, with the same
// middle. For 0 ... 199 this interval is 2 ... 197.
TEST(HistogramScale, CoreIsTwiceTheCentralInterval) {
  std::vector<double> values;
  for (int i = 0; i < 200; ++i) values.push_back((i * 77) % 200);
  values.push_back(std::numeric_limits<double>::quiet_NaN());
  const OutputScale scale = scale_for(values);
  EXPECT_EQ(scale.low, 99.5 - 195);
  EXPECT_EQ(scale.high(), 99.5 + 195);
  // Almost all values are equal, so the two other values determine the core.
  std::vector<double> rare(1000, 5.0);
  rare[17] = 1;
  rare[900] = 8;
  EXPECT_EQ(scale_for(rare).low, 4.5 - 7);
  EXPECT_EQ(scale_for(rare).high(), 4.5 + 7);
}

TEST(HistogramScale, CoreOfAConstantIsAShareOfItsValueOrOfOne) {
  const OutputScale small = scale_for({0.125, 0.125}), large = scale_for({-4, -4});
  EXPECT_EQ(small.high() - small.low, 1 / 512.0);
  EXPECT_EQ((small.high() + small.low) / 2, 0.125);
  EXPECT_EQ(large.high() - large.low, 4 / 512.0);
  EXPECT_EQ((large.high() + large.low) / 2, -4);
  EXPECT_EQ(scale_for({}).low, -1);
  EXPECT_EQ(scale_for({}).high(), 1);
}

// The width of the core is at least 2^-30 of the value; otherwise the edges of the bins could be
// equal.
TEST(HistogramScale, CoreHasALeastWidth) {
  const OutputScale narrow = scale_for({4, 4 + 0x1p-36}), wide = scale_for({4, 4 + 0x1p-28});
  EXPECT_NEAR(narrow.width * kCoreBins / 0x1p-28, 1, 1e-6);
  EXPECT_NEAR(wide.width * kCoreBins / 0x1p-27, 1, 1e-6);
}

const OutputScale kScale{-1, 2.0 / kCoreBins};

std::uint64_t index_of(double x) {
  if (x < -1) return 0;
  return x > 1 ? kCoreBins + 1 : 1 + static_cast<std::uint64_t>((x + 1) / kScale.width);
}

OutputHistogram histogram_of(const std::vector<double>& x) {
  std::vector<std::uint64_t> index;
  for (const double value : x) index.push_back(index_of(value));
  OutputHistogram counts;
  counts.add(x, index.data(), kScale);
  return counts;
}

// Beyond the core, a trial is at a distance of j widths of a bin. At each power of 2 of 64 + j the
// width of the bins doubles. Each octave has 64 bins.
TEST(OutputHistogram, CountsEveryTrial) {
  constexpr double kMost = std::numeric_limits<double>::max();
  for (const double sign : {1.0, -1.0}) {
    for (const double x : {1.5, 3.0, 1e6, kMost}) {
      OutputHistogram one = histogram_of({sign * x});
      ASSERT_EQ(one.tails().size(), 1u) << sign * x;
      const auto [key, n] = *one.tails().begin();
      EXPECT_EQ(n, 1u);
      EXPECT_GT(sign * key, 0);
      const double distance = (x - 1) / kScale.width;
      if (x < kMost) {
        EXPECT_EQ(std::abs(key),
                  1 + static_cast<int>(
                          std::floor(64 * (std::ilogb((64 + distance) / 64) - 1) +
                                     64 * std::scalbn(64 + distance, -std::ilogb(64 + distance)))));
      } else {
        EXPECT_EQ(std::abs(key), OutputHistogram::kLastTail);
      }
    }
  }
  OutputHistogram both = histogram_of({0.5, -7, 0.5, 9, -0.25});
  EXPECT_EQ(both.core(index_of(0.5) - 1), 2u);
  EXPECT_EQ(both.core(index_of(-0.25) - 1), 1u);
  EXPECT_EQ(both.tails().size(), 2u);
  both.add(histogram_of({0.5, 9}));
  EXPECT_EQ(both.core(index_of(0.5) - 1), 3u);
  EXPECT_EQ(both.tails().rbegin()->second, 2u);
  const OrderedTrials ordered(both, kScale, -7, 9);
  EXPECT_EQ(ordered.size(), 7u);
  EXPECT_EQ(ordered.value(1), -7);
  EXPECT_EQ(ordered.value(7), 9);
  EXPECT_NEAR(ordered.value(2), -0.25, kScale.width);
  for (const std::uint64_t rank : {3u, 4u, 5u}) EXPECT_NEAR(ordered.value(rank), 0.5, kScale.width);
  EXPECT_NEAR(ordered.value(6), 9, ordered.resolution(6));
  EXPECT_LT(ordered.resolution(6), 0.2);
}

// Values beyond the core must not change the counts of the first and the last bin of the core.
TEST(OutputHistogram, ValuesBeyondTheCoreDoNotChangeTheCore) {
  const OutputHistogram counts = histogram_of({-1 + kScale.width / 2, -7, 1 - kScale.width / 2, 9});
  EXPECT_EQ(counts.core(0), 1u);
  EXPECT_EQ(counts.core(kCoreBins - 1), 1u);
  EXPECT_EQ(counts.tails().size(), 2u);
}

// 32-bit counters are added to larger counters before they overflow.
TEST(OutputHistogram, MovesCountsBeforeTheyOverflow) {
  OutputHistogram counts(3);
  for (int i = 0; i < 5; ++i) {
    const std::vector<double> x = {-1 + kScale.width / 2, 0.5, 1 - kScale.width / 2};
    std::vector<std::uint64_t> index;
    for (const double value : x) index.push_back(index_of(value));
    counts.add(x, index.data(), kScale);
  }
  for (const std::uint64_t i : {std::uint64_t{1}, index_of(0.5), std::uint64_t{kCoreBins}})
    EXPECT_EQ(counts.core(i - 1), 5u);
  EXPECT_EQ(counts.core(1), 0u);
  EXPECT_EQ(counts.core(kCoreBins - 2), 0u);
}

// Four trials in one bin are placed at equal distances from the smallest value to the end of the
// bin.
TEST(OrderedTrials, AreSpreadEvenlyInTheirBin) {
  const double w = kScale.width;
  const std::vector<double> x = {0.5 * w, 0.1 * w, 0.9 * w, 0.6 * w, 3.5 * w, 7.5 * w};
  const OrderedTrials trials(histogram_of(x), kScale, 0.1 * w, 7.5 * w);
  ASSERT_EQ(trials.size(), 6u);
  EXPECT_EQ(trials.value(1), 0.1 * w);
  // The four trials are between 0.1 and 1 widths.
  EXPECT_NEAR(trials.value(2), (0.1 + 0.9 * 1.5 / 4) * w, 1e-12 * w);
  EXPECT_NEAR(trials.value(4), (0.1 + 0.9 * 3.5 / 4) * w, 1e-12 * w);
  EXPECT_NEAR(trials.value(5), 3.5 * w, 1e-12 * w);  // a single trial is in the middle of its bin
  EXPECT_EQ(trials.value(6), 7.5 * w);
  EXPECT_EQ(trials.find(4), trials.find(2));
  EXPECT_EQ(trials.find(5), trials.find(4) + 1);
  EXPECT_EQ(trials.resolution(1), 0);
  EXPECT_NEAR(trials.resolution(3) / w, 0.9, 1e-6);
  EXPECT_NEAR(trials.resolution(5) / w, 1, 1e-6);
  EXPECT_EQ(trials.resolution(6), 0);
}

}  // namespace
}  // namespace mdof::algo
