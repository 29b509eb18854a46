// Indices and comparisons of a few trials; some of the trials are unsolved. They are compared with
// the published estimators, which the test applies to each trial.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "algo/sensitivity/comparison.h"
#include "algo/sensitivity/indices.h"
#include "tests/algo/no_pattern.h"

namespace mdof::algo {
namespace {

// An experiment with two outputs and three causes. Each output is a different function of the
// random numbers of a trial.
class Tabulated final : public CausalExperiment {
 public:
  explicit Tabulated(double scale = 1) : scale_(scale) {
    outputs_ = {"one", "two"};
    causes_ = {"p", "q", "r"};
    test::NoPattern numbers(11);
    for (auto& trial : numbers_)
      for (auto& stream : trial)
        for (double& x : stream) x = numbers.between(-1, 2);
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    run_mixed(std::vector<std::uint8_t>(3, 0), first, step, n, out);
  }
  void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first, std::uint64_t step,
                 std::size_t n, std::span<double* const> out) const override {
    for (std::size_t j = 0; j < n; ++j)
      for (std::size_t k = 0; k < 2; ++k) out[k][j] = value(second, first + step * j, k);
  }
  double value(std::span<const std::uint8_t> second, std::uint64_t trial, std::size_t k) const {
    const auto x = [&](std::size_t c) { return numbers_.at(trial)[second[c]][c]; };
    if (k == 0) return 5 + x(0) + scale_ * x(1) * x(2) - 0.3 * x(2);
    // The second output is unsolved if the second cause is below -0.6, in either stream.
    return x(1) < -0.6 ? std::numeric_limits<double>::quiet_NaN()
                       : -40 + scale_ * x(0) * x(1) + 2 * x(2) * x(2);
  }

 private:
  double scale_;
  std::array<std::array<std::array<double, 3>, 2>, 60> numbers_{};
};

constexpr std::uint64_t kTrials = 7, kBlocks = 8;

double centre_of(const Tabulated& e, std::size_t output, std::uint64_t trials) {
  double sum = 0, count = 0;
  for (std::uint64_t i = 0; i < trials; ++i) {
    const double f = e.value(std::vector<std::uint8_t>(3, 0), i, output);
    if (std::isnan(f)) continue;
    sum += f;
    ++count;
  }
  return sum / count;
}

// Ratio of two sums over blocks and its standard error by Cochran, Sampling Techniques, Eq. 6.13.
// The mean of the blocks replaces the population mean.
std::pair<double, double> ratio(const std::vector<double>& y, const std::vector<double>& x) {
  double top = 0, bottom = 0, squares = 0;
  for (std::size_t b = 0; b < y.size(); ++b) top += y[b], bottom += x[b];
  for (std::size_t b = 0; b < y.size(); ++b) squares += std::pow(y[b] - top / bottom * x[b], 2);
  const auto n = static_cast<double>(y.size());
  return {top / bottom, std::sqrt(squares / (n - 1) / n) / (bottom / n)};
}

TEST(SobolByHand, EstimatorsMatchThePapers) {
  const Tabulated e;
  SobolSums sums(e, kTrials);
  for (std::uint64_t b = 0; b < kBlocks; ++b) sums.add_block(e, b);
  const auto found = sums.result();
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_EQ(found[k].key, e.outputs()[k]);
    const double c = centre_of(e, k, 16);
    // Only trials are used for which A, B and all mixtures are solved.
    double sum = 0, n = 0;
    // Outputs of the solved trials for A, B and the three mixtures ABi.
    std::vector<std::vector<std::array<double, 5>>> solved(kBlocks);
    for (std::uint64_t i = 0; i < kTrials * kBlocks; ++i) {
      std::array<double, 5> f{e.value(std::vector<std::uint8_t>{0, 0, 0}, i, k),
                              e.value(std::vector<std::uint8_t>{1, 1, 1}, i, k),
                              e.value(std::vector<std::uint8_t>{1, 0, 0}, i, k),
                              e.value(std::vector<std::uint8_t>{0, 1, 0}, i, k),
                              e.value(std::vector<std::uint8_t>{0, 0, 1}, i, k)};
      if (std::isnan(f[0] + f[1] + f[2] + f[3] + f[4])) continue;
      solved[i / kTrials].push_back(f);
      sum += f[0] + f[1];
      n += 2;
    }
    EXPECT_EQ(n == 2 * kTrials * kBlocks, k == 0);  // only the first output is solved in all trials
    std::vector<double> variance;
    std::array<std::vector<double>, 3> first, total;
    for (const auto& block : solved) {
      variance.push_back(0);
      for (std::size_t cause = 0; cause < 3; ++cause) {
        first[cause].push_back(0);
        total[cause].push_back(0);
      }
      for (const auto& f : block) {
        variance.back() += (std::pow(f[0] - sum / n, 2) + std::pow(f[1] - sum / n, 2)) / 2;
        for (std::size_t cause = 0; cause < 3; ++cause) {
          first[cause].back() += (f[1] - c) * (f[2 + cause] - f[0]);
          total[cause].back() += std::pow(f[0] - f[2 + cause], 2) / 2;
        }
      }
    }
    ASSERT_EQ(found[k].causes.size(), 3u);
    for (const CauseIndex& index : found[k].causes) {
      const auto cause = static_cast<std::size_t>(index.cause[0] - 'p');
      const auto [s, s_se] = ratio(first[cause], variance);
      const auto [t, t_se] = ratio(total[cause], variance);
      EXPECT_NEAR(index.first, s, 1e-11) << index.cause;
      EXPECT_NEAR(index.first_se, s_se, 1e-11) << index.cause;
      EXPECT_NEAR(index.total, t, 1e-11) << index.cause;
      EXPECT_NEAR(index.total_se, t_se, 1e-11) << index.cause;
    }
  }
}

TEST(SobolByHand, OneBlockHasNoStandardError) {
  const Tabulated e;
  SobolSums sums(e, 20);
  sums.add_block(e, 1);
  EXPECT_EQ(sums.blocks(), 1u);
  const auto found = sums.result();
  for (const CauseIndex& index : found[0].causes) {
    EXPECT_GT(index.total, 0);
    EXPECT_TRUE(std::isnan(index.first_se));
    EXPECT_TRUE(std::isnan(index.total_se));
  }
  EXPECT_EQ(SobolSums(e, 20).result()[0].causes[0].first, 0);  // no trials
}

TEST(ComparisonByHand, RatioAndItsStandardErrorAreCorrect) {
  const Tabulated ours, other(1.7);
  ComparisonSums sums(ours, other, kTrials);
  for (std::uint64_t b = 0; b < kBlocks; ++b) sums.add_block(ours, other, b);
  const auto found = sums.result();
  ASSERT_EQ(found.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<std::vector<std::array<double, 2>>> solved(kBlocks);
    double n = 0, x = 0, y = 0, xx = 0, yy = 0;
    const std::vector<std::uint8_t> none(3, 0);
    for (std::uint64_t i = 0; i < kTrials * kBlocks; ++i) {
      const double a = ours.value(none, i, k), b = other.value(none, i, k);
      if (std::isnan(a) || std::isnan(b)) continue;
      solved[i / kTrials].push_back({a, b});
      ++n, x += a, y += b;
    }
    for (const auto& block : solved)
      for (const auto& [a, b] : block) xx += std::pow(a - x / n, 2), yy += std::pow(b - y / n, 2);
    const double v = xx / (n - 1), w = yy / (n - 1);
    EXPECT_NEAR(found[k].sd_this, std::sqrt(v), 1e-12);
    EXPECT_NEAR(found[k].sd_other, std::sqrt(w), 1e-12);
    EXPECT_NEAR(found[k].ratio, std::sqrt(w / v), 1e-12);
    // To first order: contribution of each block to the relative change of w and v.
    double squares = 0;
    for (const auto& block : solved) {
      double off = 0;
      for (const auto& [a, b] : block)
        off += std::pow(b - y / n, 2) / w - std::pow(a - x / n, 2) / v;
      squares += off * off;
    }
    const double spread = std::sqrt(squares / (kBlocks - 1) * kBlocks) / n;
    EXPECT_NEAR(found[k].ratio_se, std::sqrt(w / v) / 2 * spread, 1e-12);
  }
}

}  // namespace
}  // namespace mdof::algo
