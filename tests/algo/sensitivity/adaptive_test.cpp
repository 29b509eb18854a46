#include "algo/sensitivity/adaptive.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/sensitivity/random.h"
#include "algo/sensitivity/simulation.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

// Example of JCGM 101 §9.2.3: the sum of four rectangular quantities of ±√3 has u = 2.0 and the 95
// % interval ±3.88.
class FourRectangular : public Experiment {
 public:
  FourRectangular() { outputs_ = {"Y_um"}; }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) {
      double sum = 0;
      for (std::uint64_t q = 0; q < 4; ++q) sum += 2 * draw({3, 0}, first + step * j, q) - 1;
      out[0][j] = std::sqrt(3.0) * sum;
    }
  }
};

AdaptiveRule rule_of(const AdaptiveTolerance& tolerance) {
  return AdaptiveRule::create({"Y_um"}, tolerance).value();
}

std::uint64_t run_until_settled(const Experiment& e, AdaptiveRule& rule, StudyStatistics& all) {
  const std::uint64_t block = adaptive_block_trials(e, 0.95).value();
  std::uint64_t at = 0;
  for (; !rule.settled() && at < 500 * block; at += block) {
    rule.add(all.add_block_with_figures(e, at, block, 0.95));
  }
  return at;
}

TEST(AdaptiveRule, SettlesForTheExampleOfTheStandard) {
  const FourRectangular e;
  AdaptiveRule rule = rule_of({2, {}});
  StudyStatistics all(e, pilot_scale(e));
  const std::uint64_t trials = run_until_settled(e, rule, all);
  // u = 2.0 with two digits has the tolerance δ = 0.05. The standard reports about 10^5 trials.
  EXPECT_DOUBLE_EQ(rule.progress().at(0).tolerance, 0.05);
  EXPECT_TRUE(rule.settled());
  EXPECT_LT(trials, 2'000'000u);
  const OutputSummary s = all.overall().at(0);
  EXPECT_NEAR(s.mean, 0, 0.05);
  EXPECT_NEAR(s.sd, 2.0, 0.05);
  EXPECT_NEAR(s.symmetric.low, -3.88, 0.05);
  EXPECT_NEAR(s.symmetric.high, 3.88, 0.05);
}

TEST(AdaptiveRule, TighterToleranceNeedsMoreTrials) {
  const FourRectangular e;
  std::uint64_t last = 0;
  for (const double tolerance_um : {0.1, 0.04, 0.02}) {
    AdaptiveRule rule = rule_of({2, {{"Y_um", tolerance_um}}});
    StudyStatistics all(e, pilot_scale(e));
    const std::uint64_t trials = run_until_settled(e, rule, all);
    EXPECT_GE(trials, last);
    EXPECT_LT(rule.progress().at(0).worst, tolerance_um);
    last = trials;
  }
  EXPECT_GT(last, 2 * adaptive_block_trials(e, 0.95).value());
}

TEST(AdaptiveRule, ToleranceIsHalfAUnitOfTheLastDigit) {
  const auto tolerance = [](double u, int digits) {
    AdaptiveRule rule = rule_of({digits, {}});
    rule.add({{10'000, 0, u, -u, u}});
    return rule.progress().at(0).tolerance;
  };
  EXPECT_DOUBLE_EQ(tolerance(2.0, 2), 0.05);
  EXPECT_DOUBLE_EQ(tolerance(0.33333, 2), 0.005);
  EXPECT_DOUBLE_EQ(tolerance(36, 1), 5);
  EXPECT_DOUBLE_EQ(tolerance(36, 2), 0.5);
  EXPECT_DOUBLE_EQ(tolerance(9.96, 2), 0.5);  // rounded to 10 = c · 10^l, c = 10, l = 0
  EXPECT_DOUBLE_EQ(tolerance(1, 1), 0.5);
  EXPECT_DOUBLE_EQ(tolerance(100, 3), 0.5);
  EXPECT_DOUBLE_EQ(tolerance(1.2e-9, 3), 0.5e-11);
}

// Two blocks have the means 1 and 3, so the standard deviation of their average is 1.
TEST(AdaptiveRule, WorstIsTwiceTheStandardDeviationOfTheAverage) {
  AdaptiveRule rule = rule_of({2, {{"Y_um", 2.5}}});
  EXPECT_FALSE(rule.settled());
  rule.add({{10'000, 1, 5, -8, 12}});
  EXPECT_FALSE(rule.settled());
  EXPECT_TRUE(std::isinf(rule.progress().at(0).worst));
  rule.add({{10'000, 3, 5, -8, 12}});
  EXPECT_DOUBLE_EQ(rule.progress().at(0).worst, 2);
  EXPECT_TRUE(rule.settled());
}

TEST(AdaptiveRule, BlockWithoutSolutionsNeverSettles) {
  AdaptiveRule rule = rule_of({2, {{"Y_um", 1}}});
  for (int i = 0; i < 5; ++i) rule.add({{}});
  EXPECT_FALSE(rule.settled());
}

TEST(AdaptiveRule, ConstantOutputSettlesAfterTwoBlocks) {
  AdaptiveRule rule = rule_of({2, {}});
  rule.add({{10'000, 4, 0, 4, 4}});
  EXPECT_FALSE(rule.settled());
  rule.add({{10'000, 4, 0, 4, 4}});
  EXPECT_TRUE(rule.settled());
}

// The output is constant within each block and differs between the blocks.
TEST(AdaptiveRule, OutputThatChangesBetweenBlocksIsNotConstant) {
  AdaptiveRule rule = rule_of({2, {}});
  rule.add({{10'000, 4, 0, 4, 4}});
  rule.add({{10'000, 6, 0, 6, 6}});
  EXPECT_FALSE(rule.progress().at(0).constant);
  EXPECT_FALSE(rule.settled());
}

TEST(AdaptiveRule, RejectsImpossibleTolerances) {
  const auto message = [](const AdaptiveTolerance& tolerance) {
    const auto rule = AdaptiveRule::create({"EAX_urad", "EBX_urad"}, tolerance);
    return rule ? std::string() : rule.error().message;
  };
  EXPECT_NE(message({0, {}}).find("digits"), std::string::npos);
  EXPECT_NE(message({7, {}}).find("digits"), std::string::npos);
  EXPECT_NE(message({2, {{"ECX_urad", 1}}}).find("EAX_urad, EBX_urad"), std::string::npos);
  EXPECT_NE(message({2, {{"EAX_urad", 0}}}).find("above zero"), std::string::npos);
}

TEST(BlockFigures, MatchTheSortedTrials) {
  const FourRectangular e;
  const std::uint64_t block = block_trials(e);
  const BlockFigures f = block_figures(e, block, block, 0.9).at(0);
  std::vector<double> x(block);
  double* const out[] = {x.data()};
  e.run(block, 1, block, out);
  std::sort(x.begin(), x.end());
  // By the standard: M = 10240, q = 9216, r = 512.
  EXPECT_EQ(f.low, x[511]);
  EXPECT_EQ(f.high, x[511 + 9216]);
  EXPECT_EQ(f.n, block);
  EXPECT_NEAR(f.u, 2, 0.1);
}

TEST(BlockFigures, AreEqualWithAndWithoutStatistics) {
  const auto e = make_simulation(simulation_2_defaults()).value();
  const std::uint64_t block = block_trials(*e);
  StudyStatistics all(*e, pilot_scale(*e));
  const auto kept = all.add_block_with_figures(*e, block, block, 0.95);
  const auto alone = block_figures(*e, block, block, 0.95);
  StudyStatistics other(*e, pilot_scale(*e));
  other.add_block(*e, block, block);
  EXPECT_EQ(all.serialise(), other.serialise());
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_EQ(kept[k].mean, alone[k].mean);
    EXPECT_EQ(kept[k].u, alone[k].u);
    EXPECT_EQ(kept[k].low, alone[k].low);
    EXPECT_EQ(kept[k].high, alone[k].high);
  }
}

TEST(AdaptiveBlocks, HaveAtLeast100TrialsOutsideTheInterval) {
  const FourRectangular e;
  EXPECT_EQ(adaptive_block_trials(e, 0.95).value(), block_trials(e));
  EXPECT_GE(adaptive_block_trials(e, 0.9999).value(), 1'000'000u);
  EXPECT_EQ(adaptive_block_trials(e, 0.9999).value() % block_trials(e), 0u);
}

// The values of a block are kept in memory, so a block of 10^12 values is refused.
TEST(AdaptiveBlocks, RejectsACoverageThatNeedsTooLongBlocks) {
  const FourRectangular e;
  EXPECT_GE(adaptive_block_trials(e, 0.99999).value(), 10'000'000u);
  for (const double coverage : {0.999999, 0.9999999999, std::nextafter(1.0, 0.0)}) {
    const auto refused = adaptive_block_trials(e, coverage);
    ASSERT_FALSE(refused) << coverage;
    EXPECT_NE(refused.error().message.find("coverage 0.99999"), std::string::npos)
        << refused.error().message;
    EXPECT_EQ(refused.error().remedy, Remedy::fix_number_of_trials);
  }
}

TEST(AdaptiveRule, NamesTheFirstOutputThatNeverSettles) {
  AdaptiveRule rule = AdaptiveRule::create({"a_um", "b_um", "c_um"}, {2, {}}).value();
  rule.add({{2, 1, 1, 0, 2}, {2, 1, 1, 0, 2}, {2, 1, 1, 0, 2}});
  EXPECT_FALSE(rule.unsettled_output());
  rule.add({{2, 1, 1, 0, 2}, {1, 1, 1, 0, 2}, {2, 1, 1, 0, 2}});
  EXPECT_EQ(rule.unsettled_output(), 1u);
  rule.add({{2, 1, 1, 0, 2}, {2, 1, 1, 0, 2}, {0, 1, 1, 0, 2}});
  EXPECT_EQ(rule.unsettled_output(), 1u);
}

}  // namespace
}  // namespace mdof::algo
