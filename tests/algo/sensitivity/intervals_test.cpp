// Ranks and intervals by JCGM 101 §7.7. The expected values are calculated by hand or by exhaustive
// search. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include "algo/sensitivity/statistics/intervals.h"

namespace mdof::algo {
namespace {

const OutputScale kIntervalScale{-1, 0x1p-12};

double bin_edge_value(std::size_t bin) {
  return kIntervalScale.low + static_cast<double>(bin) * kIntervalScale.width;
}

// p M (probability times number of trials) is 3.47, 3.55, 950 and 95.95. The rank is the integer
// part of p M + 1/2.
TEST(IntervalRanks, MatchJcgm101) {
  EXPECT_EQ(quantile_rank(0.0347, 100), 3u);
  EXPECT_EQ(quantile_rank(0.0355, 100), 4u);
  EXPECT_EQ(quantile_rank(0, 100), 1u);
  EXPECT_EQ(quantile_rank(1, 100), 100u);
  const auto symmetric = [](double p, std::uint64_t trials) {
    const IntervalRanks r = symmetric_ranks(p, trials);
    return std::pair(r.low, r.high);
  };
  using Ranks = std::pair<std::uint64_t, std::uint64_t>;
  EXPECT_EQ(symmetric(0.95, 1000), Ranks(25, 975));  // r = (1000 - 950)/2
  EXPECT_EQ(symmetric(0.95, 101), Ranks(3, 99));     // q = 96, r = (5 + 1)/2
  EXPECT_EQ(symmetric(0.5, 7), Ranks(2, 6));         // q = 4, r = (3 + 1)/2
  EXPECT_EQ(symmetric(0.0347, 100), Ranks(49, 52));  // q = 3, r = (97 + 1)/2
  EXPECT_EQ(symmetric(0.96, 100), Ranks(2, 98));     // q = 96
}

// The number of trials in a bin is a power of two, so that each length is exact. The expected
// interval is found by comparing all ranks; it is the first of the shortest intervals.
TEST(IntervalRanks, ShortestIsTheFirstOfTheSmallestLength) {
  std::uint32_t state = 12345;
  const auto next = [&](std::uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 16) % below;
  };
  for (int list = 0; list < 60; ++list) {
    OutputHistogram counts;
    std::size_t bin = 100, first = 0, last = 0;
    std::uint64_t n = 0;
    for (int k = 0; k < 5; ++k) {
      const bool end = k == 0 || k == 4;  // a single trial: the smallest or largest value
      const std::uint64_t count = std::uint64_t{1} << (end ? 0 : next(list % 2 == 0 ? 1 : 4));
      counts.add_core(bin, count);
      if (k == 0) first = bin;
      last = bin, n += count, bin += 1 + next(3);
    }
    const OrderedTrials trials(counts, kIntervalScale, bin_edge_value(first),
                               bin_edge_value(last + 1));
    ASSERT_EQ(trials.size(), n);
    for (const double coverage : {0.2, 0.5, 0.75, 0.999}) {
      const IntervalRanks found = shortest_ranks(coverage, trials);
      const std::uint64_t q = found.high - found.low;
      EXPECT_EQ(
          q, std::min(n - 1, static_cast<std::uint64_t>(coverage * static_cast<double>(n) + 0.5)));
      double least = std::numeric_limits<double>::infinity();
      std::uint64_t low = 0;
      for (std::uint64_t r = 1; r + q <= n; ++r)
        if (const double length = trials.value(r + q) - trials.value(r); length < least)
          least = length, low = r;
      EXPECT_EQ(found.low, low) << list << " " << coverage;
    }
  }
}

// There are M = 3200 trials. Rank 3 (0.001 M = 3.2) is alone in bin 1000, and rank 3197 (3196.8) is
// alone in bin 2400; both are in the middle of their bins. A tenth of their distance is 140 bins,
// so bins 860 to 2540 are drawn. These 1681 bins are drawn as bars of 15 bins.
TEST(HistogramForDrawing, ShowsTheCentralTrialsAndATenthMore) {
  OutputHistogram counts;
  for (const auto& [bin, n] : {std::pair(50u, 2u), std::pair(1000u, 1u), std::pair(1500u, 1000u),
                               std::pair(1700u, 2193u), std::pair(2400u, 1u), std::pair(8000u, 3u)})
    counts.add_core(bin, n);
  const OrderedTrials trials(counts, kIntervalScale, bin_edge_value(50), bin_edge_value(8001));
  const Histogram h = histogram_for_drawing(counts, kIntervalScale, trials);
  EXPECT_EQ(h.from, bin_edge_value(860));
  EXPECT_EQ(h.width, 15 * kIntervalScale.width);
  ASSERT_EQ(h.counts.size(), 113u);
  EXPECT_EQ(h.below, 2u);
  EXPECT_EQ(h.above, 3u);
  EXPECT_EQ(h.counts[9], 1u);      // index (1000 - 860)/15
  EXPECT_EQ(h.counts[42], 1000u);  // index (1500 - 860)/15
  EXPECT_EQ(h.counts[56], 2193u);  // index (1700 - 860)/15
  EXPECT_EQ(h.counts[102], 1u);    // index (2400 - 860)/15
}

// A fifth of the trials is beyond the core, so the histogram is from bin `first` to the last bin of
// the core. 1200 bins need bars of ten bins, 1201 bins need bars of eleven. If there are trials
// below the core, the histogram begins with the first bin of the core.
TEST(HistogramForDrawing, EndsWithTheCore) {
  const auto drawn_from = [](std::size_t first, std::uint64_t below) {
    OutputHistogram counts;
    counts.add_core(first, 40);
    if (below > 0) counts.add_tail(-200, below);
    counts.add_tail(200, 11);
    const OrderedTrials trials(counts, kIntervalScale, below > 0 ? -9 : bin_edge_value(first), 9);
    return histogram_for_drawing(counts, kIntervalScale, trials);
  };
  EXPECT_EQ(drawn_from(6992, 0).width, 10 * kIntervalScale.width);
  EXPECT_EQ(drawn_from(6991, 0).width, 11 * kIntervalScale.width);
  EXPECT_EQ(drawn_from(6992, 0).above, 11u);
  const Histogram whole = drawn_from(0, 13);
  EXPECT_EQ(whole.from, bin_edge_value(0));
  EXPECT_EQ(whole.below, 13u);
  EXPECT_EQ(whole.counts.at(0), 40u);
}

}  // namespace
}  // namespace mdof::algo
