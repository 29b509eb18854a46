// Statistics of a few trials. Each value is calculated by hand. Mutation tests (tests/mutate) found
// these cases.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "algo/sensitivity/statistics/intervals.h"
#include "algo/sensitivity/statistics/statistics.h"

namespace mdof::algo {
namespace {

// An experiment with given outputs, one for each trial. The last value is repeated.
class Given : public Experiment {
 public:
  explicit Given(std::vector<double> values, BinnedQuantity binned = {})
      : values_(std::move(values)) {
    outputs_ = {"EYX_um"};
    binned_ = std::move(binned);
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j)
      out[0][j] = values_[std::min<std::uint64_t>(first + step * j, values_.size() - 1)];
  }

 private:
  std::vector<double> values_;
};

StudyStatistics small_study(const Experiment& e, std::uint64_t trials) {
  StudyStatistics s(e, pilot_scale(e, trials));
  s.add_block(e, 0, trials);
  return s;
}

// The trials are 1, 2, 2, 3, 3, 3, 7, 11, with the mean 4. The sum of squares about the mean is 9 +
// 4 + 4 + 1 + 1 + 1 + 9 + 49 = 78. The sum of fourth powers is 81 + 16 + 16 + 1 + 1 + 1 + 81 + 2401
// = 2598.
TEST(StatisticsByHand, IsCorrectForEightTrials) {
  const Given e({1, 2, 2, 3, 3, 3, 7, 11});
  const OutputSummary s = small_study(e, 8).overall().at(0);
  const double variance = 78 / 7.0, of_variance = (2598 / 8.0 - 5 / 7.0 * variance * variance) / 8;
  EXPECT_EQ(s.n, 8u);
  EXPECT_NEAR(s.mean, 4, 1e-12);
  EXPECT_NEAR(s.sd, std::sqrt(variance), 1e-9);
  EXPECT_NEAR(s.mean_se, std::sqrt(variance / 8), 1e-9);
  EXPECT_NEAR(s.sd_se, std::sqrt(of_variance / variance) / 2, 1e-3);
  EXPECT_EQ(s.min, 1);
  EXPECT_EQ(s.max, 11);
}

TEST(StatisticsByHand, IsCorrectForTwoTrialsAndOne) {
  const OutputSummary two = small_study(Given({1, 3}), 2).overall().at(0);
  EXPECT_NEAR(two.mean, 2, 1e-12);
  EXPECT_NEAR(two.sd, std::sqrt(2), 1e-9);
  EXPECT_NEAR(two.mean_se, 1, 1e-9);
  const OutputSummary one = small_study(Given({3}), 1).overall().at(0);
  EXPECT_EQ(one.mean, 3);
  EXPECT_TRUE(std::isnan(one.sd) && std::isnan(one.mean_se) && std::isnan(one.sd_se));
}

TEST(StatisticsByHand, HasTheDefaultQuantiles) {
  std::vector<double> asked;
  const OutputSummary s = small_study(Given({1, 3}), 2).overall().at(0);
  for (const Quantile& q : s.quantiles) asked.push_back(q.p);
  EXPECT_EQ(asked, (std::vector<double>{0.025, 0.25, 0.5, 0.75, 0.975}));
}

// Each bin ends where the next bin begins, and the last bin ends at exactly 0.7. The sum 0.1 + 3 ×
// 0.2 would be larger.
TEST(StatisticsByHand, BinsAreContiguous) {
  const auto bins = small_study(Given({1, 2, 3}, {"travel_mm", 0.1, 0.7, 3}), 7).bins();
  ASSERT_EQ(bins.size(), 3u);
  EXPECT_EQ(bins[0].from, 0.1);
  EXPECT_NEAR(bins[1].from, 0.3, 1e-15);
  EXPECT_NEAR(bins[2].from, 0.5, 1e-15);
  EXPECT_EQ(bins[0].to, bins[1].from);
  EXPECT_EQ(bins[1].to, bins[2].from);
  EXPECT_EQ(bins[2].to, 0.7);
  EXPECT_EQ(bins[0].outputs[0].n, 3u);
  EXPECT_EQ(bins[1].outputs[0].n, 2u);
  EXPECT_EQ(bins[2].outputs[0].n, 2u);
  EXPECT_TRUE(small_study(Given({1, 2, 3}), 7).bins().empty());
}

TEST(StatisticsByHand, BlockIsTheSmallestSufficientMultiple) {
  EXPECT_EQ(block_trials(Given({1}), 1), 512u);
  EXPECT_EQ(block_trials(Given({1}), 512), 512u);
  EXPECT_EQ(block_trials(Given({1}), 513), 1024u);
  EXPECT_EQ(block_trials(Given({1})), 20 * 512u);
  EXPECT_EQ(block_trials(Given({1}, {"travel_mm", 0, 1, 3}), 1537), 3072u);
}

// At least 100/(1 - coverage) trials are necessary, in blocks of 10240: 10204 trials in one block,
// 10246 in two.
TEST(StatisticsByHand, AdaptiveBlockHas100TrialsOutsideTheInterval) {
  EXPECT_EQ(adaptive_block_trials(Given({1}), 0.5).value(), 10240u);
  EXPECT_EQ(adaptive_block_trials(Given({1}), 0.9902).value(), 10240u);
  EXPECT_EQ(adaptive_block_trials(Given({1}), 0.99024).value(), 20480u);
}

// Trials of -0 and of +0 follow a first value, in both orders.
TEST(StatisticsByHand, ZeroHasOneSignInAnyOrder) {
  for (const double first : {5.0, -5.0}) {
    std::vector<double> values(1024, 0.0);
    std::fill_n(values.begin(), 512, -0.0);
    values[0] = values[512] = first;
    const Given e(values);
    StudyStatistics a(e, pilot_scale(e)), b(e, pilot_scale(e));
    a.add_block(e, 0, 512), a.add_block(e, 512, 512);
    b.add_block(e, 512, 512), b.add_block(e, 0, 512);
    EXPECT_EQ(a.serialise(), b.serialise()) << first;
    const OutputSummary s = a.overall()[0];
    EXPECT_FALSE(std::signbit(first > 0 ? s.min : s.max)) << first;
  }
}

// The trials are 1, 4, 9 ... The numbers of trials are not multiples of the vector length.
TEST(StatisticsByHand, IsCorrectForAnyNumberAndInstructionSet) {
  std::vector<double> squares;
  for (int i = 1; i <= 17; ++i) squares.push_back(i * i);
  const Given e(squares);
  for (const InstructionSet set : available_instruction_sets()) {
    for (std::uint64_t n = 2; n <= 17; ++n) {
      StudyStatistics n_trial_study(e, pilot_scale(e, 17), set);
      n_trial_study.add_block(e, 0, n);
      const OutputSummary s = n_trial_study.overall().at(0);
      const auto x = static_cast<double>(n);
      EXPECT_EQ(s.n, n);
      EXPECT_NEAR(s.mean, (x + 1) * (2 * x + 1) / 6, 1e-9) << n;
      // The sum of fourth powers is n (n + 1) (2n + 1) (3n² + 3n - 1)/30.
      const double fourth = (x + 1) * (2 * x + 1) * (3 * x * x + 3 * x - 1) / 30;
      EXPECT_NEAR(s.sd, std::sqrt((fourth - s.mean * s.mean) * x / (x - 1)), 1e-6) << n;
      EXPECT_EQ(s.min, 1);
      EXPECT_EQ(s.max, x * x);
    }
  }
}

TEST(StatisticsByHand, KeepsUnsolvedTrials) {
  const Given e({1, std::nan(""), 3, std::nan(""), 5});
  const auto read = StudyStatistics::parse(small_study(e, 5).serialise(), e);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->trials(), 5u);
  EXPECT_EQ(read->overall().at(0).n, 3u);
  EXPECT_EQ(read->overall().at(0).unsolved, 2u);
  EXPECT_NEAR(read->overall().at(0).mean, 3, 1e-12);
}

// A count of 0 in bin 0 is the end of a histogram. Bytes that end with a count of 0 in bin 1 are
// damaged.
TEST(StatisticsByHand, ChecksTheEndOfAHistogram) {
  const Given e({1, 3});
  std::string bytes = small_study(e, 2).serialise();
  ASSERT_TRUE(StudyStatistics::parse(bytes, e));
  ASSERT_EQ(bytes.substr(bytes.size() - 3), std::string(3, '\0'));
  bytes.pop_back();
  bytes[bytes.size() - 2] = 1;
  EXPECT_FALSE(StudyStatistics::parse(bytes, e));
}

// A histogram with one trial in each of `n` bins from bin 1000 on, `beyond` trials below the core,
// and `beyond` + 1 trials above it.
Histogram drawn(std::size_t n, std::uint64_t beyond = 0) {
  const OutputScale scale{-1, 0x1p-12};
  OutputHistogram counts;
  for (std::size_t i = 0; i < n; ++i) counts.add_core(1000 + i, 1);
  if (beyond > 0) counts.add_tail(-3, beyond), counts.add_tail(2, beyond + 1);
  const double low = scale.low + 1000 * scale.width;
  const OrderedTrials trials(counts, scale, beyond > 0 ? -1.1 : low,
                             beyond > 0 ? 1.1 : low + (static_cast<double>(n) - 0.5) * scale.width);
  return histogram_for_drawing(counts, scale, trials);
}

// Up to 120 bins have one bar each. With more bins, two bins share a bar, then three, and so on.
TEST(HistogramForDrawing, HasUpTo120Bars) {
  for (const auto& [bins, together, bars] :
       {std::tuple(120u, 1u, 120u), std::tuple(121u, 2u, 61u), std::tuple(240u, 2u, 120u),
        std::tuple(241u, 3u, 81u)}) {
    const Histogram h = drawn(bins);
    EXPECT_EQ(h.from, -1 + 1000 * 0x1p-12) << bins;
    EXPECT_EQ(h.width, together * 0x1p-12) << bins;
    ASSERT_EQ(h.counts.size(), bars) << bins;
    for (std::size_t i = 0; i + 1 < bars; ++i) EXPECT_EQ(h.counts[i], together) << bins;
    EXPECT_EQ(h.counts.back(), bins - (bars - 1) * together) << bins;
    EXPECT_EQ(h.below + h.above, 0u);
  }
}

// There are 2011 trials: five below the bins and six above.
TEST(HistogramForDrawing, CountsTrialsBeyondTheBars) {
  const Histogram h = drawn(2000, 5);
  EXPECT_GE(h.below, 5u);
  EXPECT_GE(h.above, 6u);
  std::uint64_t inside = 0;
  for (const std::uint64_t n : h.counts) inside += n;
  EXPECT_EQ(h.below + inside + h.above, 2011u);
}

}  // namespace
}  // namespace mdof::algo
