// Two experiments with a few trials, whose standard deviations are calculated by hand.
#include "algo/sensitivity/comparison.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

// An experiment with one output. The test gives its value in each trial; NaN: the trial has no
// solution.
class Given : public Experiment {
 public:
  Given(std::string key, std::vector<double> values) : values_(std::move(values)) {
    outputs_ = {std::move(key)};
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j) out[0][j] = values_[first + step * j];
  }

 private:
  std::vector<double> values_;
};

std::vector<ComparedOutput> compared(const Given& ours, const Given& other) {
  ComparisonSums sums(ours, other, 2), later(ours, other, 2);
  sums.add_block(ours, other, 0);
  later.add_block(ours, other, 1);
  sums.merge(later);
  return sums.result();
}

// The values 1, 2, 3, 4 have the variance 5/3. The values 2, 0, 2, 8 have the mean 3 and the
// variance 12: the sum of squares 36 = 1 + 9 + 1 + 25, divided by 3.
TEST(ComparisonByHand, FourTrialsGiveTheExpectedRatio) {
  const auto result = compared({"EYX_um", {1, 2, 3, 4}}, {"EYX_um", {2, 0, 2, 8}});
  ASSERT_EQ(result.size(), 1u);
  EXPECT_EQ(result[0].key, "EYX_um");
  EXPECT_NEAR(result[0].sd_this, std::sqrt(5.0 / 3), 1e-12);
  EXPECT_NEAR(result[0].sd_other, std::sqrt(12.0), 1e-12);
  EXPECT_NEAR(result[0].ratio, std::sqrt(12 * 3 / 5.0), 1e-12);
  // In each block of two trials, the sum of the squares about the mean is divided by the variance
  // of its experiment. The difference of both quotients is other minus this.
  // First block, sums of squares 2.25 + 0.25 (this) and 1 + 9 (other): 10/12 - 2.5 × 3/5 = -2/3.
  // Second block, sums of squares 2.5 (this) and 1 + 25 (other): 26/12 - 2.5 × 3/5 = 2/3.
  // Standard error of the ratio: ratio/2 √(2 × 2 × 4/9)/4 = ratio/6.
  EXPECT_NEAR(result[0].ratio_se, result[0].ratio / 6, 1e-12);
}

TEST(ComparisonByHand, TrialUnsolvedByOneIsExcludedFromBoth) {
  const double nan = std::nan("");
  const auto result = compared({"EYX_um", {1, 2, nan, 4}}, {"EYX_um", {2, nan, 7, 8}});
  ASSERT_EQ(result.size(), 1u);  // 1 and 4, 2 and 8 remain
  EXPECT_NEAR(result[0].sd_this, std::sqrt(4.5), 1e-12);
  EXPECT_NEAR(result[0].sd_other, std::sqrt(18.0), 1e-12);
}

// Both experiments solve the second block only. Their values 2, 4 and 1, 5 have the variances 2 and
// 8.
TEST(ComparisonByHand, UnsolvedBlockDoesNotHideOtherBlocks) {
  const double nan = std::nan("");
  const auto result = compared({"EYX_um", {nan, nan, 2, 4}}, {"EYX_um", {nan, nan, 1, 5}});
  EXPECT_NEAR(result[0].sd_this, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(result[0].sd_other, std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(result[0].ratio, 2, 1e-12);
}

// The variances of these values are far below 1.
TEST(ComparisonByHand, SmallValuesHaveAStandardError) {
  const auto result = compared({"EYX_um", {0.1, 0.2, 0.3, 0.4}}, {"EYX_um", {0.2, 0, 0.2, 0.8}});
  EXPECT_NEAR(result[0].ratio, std::sqrt(12 * 3 / 5.0), 1e-12);
  EXPECT_NEAR(result[0].ratio_se, result[0].ratio / 6, 1e-12);
}

TEST(ComparisonByHand, OutputOfOnlyOneExperimentIsNotCompared) {
  EXPECT_TRUE(compared({"EYX_um", {1, 2, 3, 4}}, {"EZX_um", {1, 2, 3, 4}}).empty());
}

TEST(ComparisonByHand, ConstantOutputHasNoRatio) {
  const auto result = compared({"EYX_um", {3, 3, 3, 3}}, {"EYX_um", {1, 2, 3, 4}});
  EXPECT_EQ(result[0].sd_this, 0);
  EXPECT_TRUE(std::isnan(result[0].ratio));
  EXPECT_TRUE(std::isnan(result[0].ratio_se));
}

TEST(ComparisonByHand, SingleTrialHasNoScatter) {
  const double nan = std::nan("");
  const auto result = compared({"EYX_um", {nan, 2, nan, nan}}, {"EYX_um", {1, 3, 2, 5}});
  ASSERT_EQ(result.size(), 1u);
  EXPECT_EQ(result[0].sd_this, 0);
  EXPECT_EQ(result[0].sd_other, 0);
  EXPECT_TRUE(std::isnan(result[0].ratio));
}

}  // namespace
}  // namespace mdof::algo
