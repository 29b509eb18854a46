// Tests tolerances and comparisons for linear outputs of normal quantities, whose results are
// known.
#include "algo/sensitivity/allocation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "algo/sensitivity/comparison.h"

namespace mdof::algo {
namespace {

StudyPlan plan_of(const std::string& rest, const std::string& rig = "../five-probe/rig_X.toml") {
  auto plan = parse_study_plan("name = \"t\"\nrig = \"" + rig +
                                   "\"\noutputs = [\"EBX_urad\"]\nforward = \"small-angle\"\n" +
                                   "[truth]\ntravel_mm = [30]\n" + rest,
                               MDOF_TEST_DATA "/sensitivity/plan.toml");
  EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
  return plan.value_or(StudyPlan{});
}

std::string drift(const std::string& probe, double sd) {
  return "[[quantity]]\nname = \"probe." + probe +
         ".drift_nm\"\ndistribution = \"normal\"\nsd = " + std::to_string(sd) + "\n";
}

std::string allocation(const std::string& tolerances, double limit, const std::string& p = "0.95") {
  return "[[allocation]]\noutput = \"EBX_urad\"\nlimit = " + std::to_string(limit) +
         "\nprobability = " + p + "\ntolerances = [" + tolerances + "]\ntrials = 10000\n";
}

constexpr double k95 = 1.9599639845400543;

Allocation allocate_first(const StudyPlan& plan) {
  const auto e = make_plan_experiment(plan).value();
  return allocate(*e, plan.allocations.at(0)).value();
}

// εy = ((B + C)/2 - A)/l with l = 10 mm: the standard deviation is √(a² + (b² + c²)/4)/10 µrad if
// a, b, c are the standard deviations in nm. The relative sampling uncertainty of the 95 % quantile
// of 10000 trials is about 1.1 %.
TEST(Allocation, FindsTheTolerancesOfALinearOutput) {
  const double limit = 2;
  const Allocation found =
      allocate_first(plan_of(drift("A", 6) + drift("B", 8) +
                             allocation("\"probe.A.drift_nm\", \"probe.B.drift_nm\"", limit)));
  const double allowed = limit * 10 / k95;  // limit of √(a² + b²/4), nm
  const auto expected_probability = [&](double sd) {
    return std::erf(limit * 10 / sd / std::sqrt(2.0));
  };
  EXPECT_NEAR(found.reached, expected_probability(std::sqrt(36 + 16.0)),
              5 * std::sqrt(0.05 / 10000));
  ASSERT_EQ(found.alone.size(), 2U);
  const double a = std::sqrt(allowed * allowed - 16), b = 2 * std::sqrt(allowed * allowed - 36);
  EXPECT_EQ(found.alone[0].tolerance, "probe.A.drift_nm");
  EXPECT_NEAR(found.alone[0].value / a, 1, 0.05);
  EXPECT_NEAR(found.alone[1].value / b, 1, 0.05);
  EXPECT_NEAR(found.common_factor, allowed / std::sqrt(36 + 16.0), 0.03);
  for (const auto& t : found.alone) {
    EXPECT_LT(t.low, t.value);
    EXPECT_GT(t.high, t.value);
    EXPECT_NEAR((t.high - t.low) / t.value, 0.05, 0.03);
  }
  ASSERT_EQ(found.frontier.size(), 8U);
  for (const auto& pair : found.frontier) {
    const double a_nm = pair[0].value, b_nm = pair[1].value;
    EXPECT_NEAR((a_nm * a_nm + b_nm * b_nm / 4) / (allowed * allowed), 1, 0.1);
  }
  EXPECT_EQ(found.frontier[0][0].value, 0);
  EXPECT_NEAR(found.frontier[7][0].value / allowed, 1, 0.03);
}

// For about 19 of 20 seeds the interval must contain the true tolerance.
TEST(Allocation, SamplingBoundsHoldTheTruth) {
  int held = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    StudyPlan plan = plan_of(drift("A", 6) + allocation("\"probe.A.drift_nm\"", 2));
    plan.seed = seed;
    plan.allocations[0].trials = 2000;
    const auto t = allocate_first(plan).alone[0];
    held += t.low <= 20 / k95 && 20 / k95 <= t.high;
  }
  EXPECT_GE(held, 16);
}

TEST(Allocation, ALimitThatOthersBreakAllowsNothing) {
  const Allocation found =
      allocate_first(plan_of(drift("A", 60) + drift("B", 1) +
                             allocation("\"probe.B.drift_nm\", \"probe.A.drift_nm\"", 2)));
  EXPECT_EQ(found.alone[0].value, 0);
  EXPECT_GT(found.alone[1].value, 0);
  EXPECT_LT(found.alone[1].value, 60);
}

TEST(Allocation, ToleranceWithoutEffectIsUnlimited) {
  const Allocation found = allocate_first(
      plan_of(drift("A", 1) + drift("D", 1) + allocation("\"probe.D.drift_nm\"", 2)));
  EXPECT_EQ(found.alone[0].value, std::numeric_limits<double>::infinity());
  EXPECT_EQ(found.reached, 1);
}

TEST(Allocation, IsTheSameHoweverItsTasksAreRun) {
  const StudyPlan plan = plan_of(drift("A", 6) + allocation("\"probe.A.drift_nm\"", 2));
  const auto e = make_plan_experiment(plan).value();
  const auto forward = allocate(*e, plan.allocations[0]).value();
  const auto backward = allocate(*e, plan.allocations[0], [](std::size_t n, const auto& task) {
                          while (n > 0) task(--n);
                        }).value();
  EXPECT_EQ(forward.alone[0].value, backward.alone[0].value);
  EXPECT_EQ(forward.reached, backward.reached);
}

// The size of the output of trial j of n = 300 is scale × (1 + spread j/n). Without a spread, a
// trial is within a limit if its scale is at most this limit.
class Proportional : public ScalableExperiment {
 public:
  explicit Proportional(double spread = 0) : spread_(spread) {
    outputs_ = {"EBX_urad"};
    quantities_ = causes_ = {"probe.A.drift_nm"};
    sizes_ = {3};
  }
  std::vector<std::pair<std::string, double>> inputs(std::uint64_t) const override { return {}; }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    run_scaled(std::vector<double>{1}, first, step, n, out);
  }
  void run_mixed(std::span<const std::uint8_t>, std::uint64_t first, std::uint64_t step,
                 std::size_t n, std::span<double* const> out) const override {
    run(first, step, n, out);
  }
  void run_scaled(std::span<const double> scale, std::uint64_t first, std::uint64_t step,
                  std::size_t n, std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) {
      last_ = std::max(last_, first + step * j);
      const double size = scale[0] * (1 + spread_ * static_cast<double>(first + step * j) / 300);
      out[0][j] = j % 2 ? size : -size;
    }
  }
  std::uint64_t last() const { return last_; }

 private:
  double spread_ = 0;
  mutable std::uint64_t last_ = 0;
};

double largest_factor(double limit) {
  const Proportional e;
  const PlannedAllocation planned{"EBX_urad",           limit, 0.95,
                                  {"probe.A.drift_nm"}, 300,   "plan.toml:9"};
  const Allocation found = allocate(e, planned).value();
  EXPECT_EQ(e.last(), 299u);
  EXPECT_EQ(found.reached, limit >= 1 ? 1 : 0);
  EXPECT_EQ(found.alone.at(0).value, 3 * found.common_factor);
  EXPECT_EQ(found.alone.at(0).low, found.alone.at(0).value);
  EXPECT_EQ(found.alone.at(0).high, found.alone.at(0).value);
  return found.common_factor;
}

// If the factor is a power of two it is found exactly, otherwise by bisection with an error of
// 5e-4. Limits from 2^20 on allow everything, limits below 2^-20 nothing.
TEST(Allocation, EqualsTheLimitOfAProportionalOutput) {
  for (const double limit : {1.0, 8.0, 0x1p19, 0.25, 0x1p-19})
    EXPECT_EQ(largest_factor(limit), limit);
  for (const double limit : {1.3, 7.9, 1000.1, 0.9, 0.013, 0x1.8p19, 0x1.8p-20}) {
    EXPECT_LE(largest_factor(limit), limit);
    EXPECT_GE(largest_factor(limit), (1 - 5e-4) * limit);
  }
  EXPECT_EQ(largest_factor(0x1p20), std::numeric_limits<double>::infinity());
  EXPECT_EQ(largest_factor(0x1.8p20), std::numeric_limits<double>::infinity());
  EXPECT_EQ(largest_factor(0x1.8p-21), 0);
}

// 300 trials have outputs from 1 to 2 at the scale 1; 285 trials must be within 10. The 285th in
// order is 1 + 284/300. The bounds follow from the 277th and the 293rd trial: 285 ± 1.96 √(300 ·
// 0.95 · 0.05) = 277.6 and 292.4.
TEST(Allocation, MatchesTheOrderStatistic) {
  const Proportional e(1);
  const PlannedAllocation planned{"EBX_urad", 10, 0.95, {"probe.A.drift_nm"}, 300, "plan.toml:9"};
  const Allocation found = allocate(e, planned).value();
  const auto expect_just_below = [](double got, int rank) {
    const double largest = 3 * 10 / (1 + (rank - 1) / 300.0);
    EXPECT_LE(got, largest * (1 + 1e-12)) << rank;
    EXPECT_GE(got, largest * (1 - 5e-4)) << rank;
  };
  expect_just_below(found.alone.at(0).value, 285);
  expect_just_below(found.alone.at(0).low, 293);
  expect_just_below(found.alone.at(0).high, 277);
  const PlannedAllocation tight{"EBX_urad", 1.5, 0.95, {"probe.A.drift_nm"}, 300, "plan.toml:9"};
  EXPECT_EQ(allocate(e, tight)->reached, 151 / 300.0);
}

TEST(Allocation, RejectsAnUnknownOutput) {
  const StudyPlan plan = plan_of(drift("A", 6));
  const auto e = make_plan_experiment(plan).value();
  PlannedAllocation planned{"EZX_um", 1, 0.95, {"probe.A.drift_nm"}, 1000, "plan.toml:9"};
  const auto found = allocate(*e, planned);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().message, "plan.toml:9: this study has no output \"EZX_um\"");
}

// In each trial the reading errors of both rigs are equal. If the distance of the probes is
// doubled, the angle is half as large.
TEST(Comparison, TwiceTheWidthHalvesTheAngles) {
  const StudyPlan plan = plan_of(drift("*", 6) + "[compare]\nrig = \"rig_wide.toml\"\n");
  const auto ours = make_plan_experiment(plan).value();
  const auto other = make_compared_experiment(plan).value();
  ComparisonSums sums(*ours, *other, 500), reversed(*ours, *other, 500);
  for (std::uint64_t b = 0; b < 20; ++b) sums.add_block(*ours, *other, b);
  for (std::uint64_t b = 20; b-- > 0;) reversed.add_block(*ours, *other, b);
  const auto result = sums.result();
  ASSERT_EQ(result.size(), 1U);
  EXPECT_EQ(result[0].key, "EBX_urad");
  EXPECT_NEAR(result[0].ratio, 0.5, 1e-5);
  EXPECT_LT(result[0].ratio_se, 1e-5);
  EXPECT_NEAR(result[0].sd_this, 0.6 * std::sqrt(1.5), 0.02);
  EXPECT_EQ(reversed.result()[0].ratio, result[0].ratio);
}

TEST(Comparison, StandardErrorHoldsForPairedTrials) {
  // The drift of A is twice as large in the second plan, the drift of B is equal in both. A and B
  // are independent.
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    StudyPlan small = plan_of(drift("A", 3) + drift("B", 8));
    StudyPlan large = plan_of(drift("A", 6) + drift("B", 8));
    small.seed = large.seed = seed;
    const auto a = make_plan_experiment(small).value(), b = make_plan_experiment(large).value();
    ComparisonSums sums(*a, *b, 100);
    for (std::uint64_t block = 0; block < 40; ++block) sums.add_block(*a, *b, block);
    const auto c = sums.result()[0];
    const double z = (c.ratio - std::sqrt((36 + 16.0) / (9 + 16))) / c.ratio_se;
    squares += z * z;
  }
  EXPECT_NEAR(squares / 30, 1, 0.8);
}

// All trials of a whole number of tasks, of one more and of one less are counted.
TEST(Allocation, CountsEachTrial) {
  StudyPlan plan = plan_of(drift("A", 6) + allocation("\"probe.A.drift_nm\"", 1e6));
  for (const std::uint64_t trials : {127u, 128u, 129u, 255u, 256u, 257u}) {
    plan.allocations.at(0).trials = trials;
    EXPECT_EQ(allocate_first(plan).reached, 1) << trials;
  }
}

}  // namespace
}  // namespace mdof::algo
