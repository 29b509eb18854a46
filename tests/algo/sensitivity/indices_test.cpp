// Sobol indices of functions whose indices are known in closed form.
#include "algo/sensitivity/indices.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "algo/sensitivity/comparison.h"
#include "algo/sensitivity/plan/experiment.h"
#include "algo/sensitivity/random.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr std::uint64_t kBlockTrials = 4096;

// A function of independent uniform random numbers between 0 and 1.
class FunctionExperiment final : public CausalExperiment {
 public:
  using Function = std::function<double(const std::vector<double>&)>;
  FunctionExperiment(std::size_t inputs, std::uint64_t seed, Function f)
      : seed_(seed), f_(std::move(f)) {
    outputs_ = {"y"};
    for (std::size_t i = 0; i < inputs; ++i) causes_.push_back("x" + std::to_string(i + 1));
  }
  void run(std::uint64_t first, std::uint64_t step, std::size_t n,
           std::span<double* const> out) const override {
    const std::vector<std::uint8_t> none(causes_.size(), 0);
    run_mixed(none, first, step, n, out);
  }
  void run_mixed(std::span<const std::uint8_t> second, std::uint64_t first, std::uint64_t step,
                 std::size_t n, std::span<double* const> out) const override {
    std::vector<double> x(causes_.size());
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < x.size(); ++i)
        x[i] = draw({seed_, second[i]}, first + step * j, i);
      out[0][j] = f_(x);
    }
  }

 private:
  std::uint64_t seed_;
  Function f_;
};

constexpr double kPi = 3.14159265358979323846;

// The function of Ishigami & Homma (1990) with a = 7 and b = 0.1.
double ishigami(const std::vector<double>& u) {
  const double sine1 = sine_of_turns(u[0] - 0.5), sine2 = sine_of_turns(u[1] - 0.5);
  const double x3 = 2 * kPi * (u[2] - 0.5);
  return sine1 + 7 * sine2 * sine2 + 0.1 * x3 * x3 * x3 * x3 * sine1;
}

// Sobol's g-function: the product of (|4x - 2| + a)/(1 + a), with these values of a.
const std::vector<double> kA = {0, 1, 4.5, 9, 99, 99, 99, 99};
double g_function(const std::vector<double>& u) {
  double product = 1;
  for (std::size_t i = 0; i < u.size(); ++i)
    product *= (std::abs(4 * u[i] - 2) + kA[i]) / (1 + kA[i]);
  return product;
}

struct Known {
  double first, total;
};

std::vector<Known> ishigami_known() {
  const double a = 7, b = 0.1, pi4 = std::pow(kPi, 4), pi8 = pi4 * pi4;
  const double v1 = 0.5 * (1 + b * pi4 / 5) * (1 + b * pi4 / 5), v2 = a * a / 8;
  const double v13 = b * b * pi8 * (1.0 / 18 - 1.0 / 50), v = v1 + v2 + v13;
  return {{v1 / v, (v1 + v13) / v}, {v2 / v, v2 / v}, {0, v13 / v}};
}

std::vector<Known> g_known() {
  double all = 1;
  for (const double a : kA) all *= 1 + 1 / (3 * (1 + a) * (1 + a));
  std::vector<Known> known;
  for (const double a : kA) {
    const double v = 1 / (3 * (1 + a) * (1 + a));
    known.push_back({v / (all - 1), v * all / (1 + v) / (all - 1)});
  }
  return known;
}

SobolSums sums_of(const CausalExperiment& e, std::uint64_t blocks) {
  SobolSums sums(e, kBlockTrials);
  for (std::uint64_t b = 0; b < blocks; ++b) sums.add_block(e, b);
  return sums;
}

std::map<std::string, CauseIndex> by_cause(const SobolSums& sums) {
  std::map<std::string, CauseIndex> found;
  const OutputIndices first = sums.result()[0];
  for (const auto& c : first.causes) found[c.cause] = c;
  return found;
}

void expect_known(const FunctionExperiment& e, const std::vector<Known>& known) {
  const auto found = by_cause(sums_of(e, 32));
  for (std::size_t i = 0; i < known.size(); ++i) {
    const CauseIndex& c = found.at("x" + std::to_string(i + 1));
    EXPECT_NEAR(c.first, known[i].first, 5 * c.first_se) << c.cause;
    EXPECT_NEAR(c.total, known[i].total, 5 * c.total_se) << c.cause;
    EXPECT_LT(c.first_se, 0.01);
    EXPECT_LT(c.total_se, 0.01);
  }
}

TEST(Sobol, IshigamiFunctionHasItsAnalyticIndices) {
  expect_known(FunctionExperiment(3, 1, ishigami), ishigami_known());
}

TEST(Sobol, GFunctionHasItsAnalyticIndices) {
  expect_known(FunctionExperiment(8, 2, g_function), g_known());
}

// The indices of 30 seeds deviate from the truth. If the standard errors are correct, the mean
// square of deviation / standard error is 1.
TEST(Sobol, StandardErrorsAreCorrect) {
  const auto known = ishigami_known();
  double first = 0, total = 0, worst = 0;
  int n = 0;
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    const FunctionExperiment e(3, seed, ishigami);
    SobolSums sums(e, 256);
    for (std::uint64_t b = 0; b < 32; ++b) sums.add_block(e, b);
    const auto found = by_cause(sums);
    for (std::size_t i = 0; i < 3; ++i) {
      const CauseIndex& c = found.at("x" + std::to_string(i + 1));
      const double z1 = (c.first - known[i].first) / c.first_se;
      const double zt = (c.total - known[i].total) / c.total_se;
      first += z1 * z1;
      total += zt * zt;
      worst = std::max({worst, std::abs(z1), std::abs(zt)});
      ++n;
    }
  }
  // 90 squares that are nearly independent have the mean 1 ± 0.15.
  EXPECT_NEAR(first / n, 1, 0.6);
  EXPECT_NEAR(total / n, 1, 0.6);
  EXPECT_LT(worst, 5);
}

TEST(SumBlocks, SufficeForAStandardErrorOfFewTrials) {
  for (const std::uint64_t trials : {30u, 63u, 64u, 127u, 1000u, 10'000u, 65'536u, 1u << 18}) {
    const std::uint64_t each = sum_block_trials(trials);
    EXPECT_GE(trials / each, kFewSumBlocks) << trials;
    EXPECT_LE(each, 4096u);
  }
}

// The same test as StandardErrorsAreCorrect, with blocks of one trial.
TEST(Sobol, StandardErrorsAreCorrectInBlocksOfOneTrial) {
  const auto known = ishigami_known();
  double total = 0;
  for (std::uint64_t seed = 200; seed < 400; ++seed) {
    const FunctionExperiment e(3, seed, ishigami);
    SobolSums sums(e, 1);
    for (std::uint64_t b = 0; b < 100; ++b) sums.add_block(e, b);
    const CauseIndex c = by_cause(sums).at("x2");
    total += std::pow((c.total - known[1].total) / c.total_se, 2);
  }
  EXPECT_NEAR(total / 200, 1, 0.35);
}

// As above, for a comparison of two experiments; x1 is twice as large in the second. 200 seeds of
// 100 trials.
TEST(Comparison, StandardErrorIsCorrectInBlocksOfOneTrial) {
  double squares = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    const FunctionExperiment ours(
        2, seed, [](const std::vector<double>& u) { return gaussian(u[0]) + gaussian(u[1]); });
    const FunctionExperiment other(
        2, seed, [](const std::vector<double>& u) { return 2 * gaussian(u[0]) + gaussian(u[1]); });
    ComparisonSums sums(ours, other, 1);
    for (std::uint64_t b = 0; b < 100; ++b) sums.add_block(ours, other, b);
    const ComparedOutput c = sums.result().at(0);
    squares += std::pow((c.ratio - std::sqrt(2.5)) / c.ratio_se, 2);
  }
  EXPECT_NEAR(squares / 200, 1, 0.35);
}

TEST(Sobol, DoesNotDependOnTheOrderOfBlocks) {
  const FunctionExperiment e(3, 3, ishigami);
  const auto forward = sums_of(e, 6).result()[0];
  SobolSums one(e, kBlockTrials), two(e, kBlockTrials);
  for (const std::uint64_t b : {5U, 0U, 3U}) one.add_block(e, b);
  for (const std::uint64_t b : {4U, 2U, 1U}) two.add_block(e, b);
  two.merge(one);
  const auto merged = two.result()[0];
  ASSERT_EQ(two.blocks(), 6U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(merged.causes[i].cause, forward.causes[i].cause);
    EXPECT_EQ(merged.causes[i].first, forward.causes[i].first);
    EXPECT_EQ(merged.causes[i].total_se, forward.causes[i].total_se);
  }
}

TEST(Sobol, LargestTotalComesFirst) {
  const auto causes = sums_of(FunctionExperiment(8, 4, g_function), 4).result()[0].causes;
  EXPECT_EQ(causes[0].cause, "x1");
  for (std::size_t i = 1; i < causes.size(); ++i) EXPECT_LE(causes[i].total, causes[i - 1].total);
}

TEST(Sobol, ConstantOutputHasZeroIndices) {
  const FunctionExperiment e(2, 5, [](const std::vector<double>&) { return 3.0; });
  const OutputIndices result = sums_of(e, 3).result()[0];
  for (const auto& c : result.causes) {
    EXPECT_EQ(c.first, 0);
    EXPECT_EQ(c.total, 0);
  }
}

TEST(Sobol, LeavesOutUnsolvedTrials) {
  const FunctionExperiment e(
      2, 6, [](const std::vector<double>& u) { return u[0] < 0.1 ? std::nan("") : u[0] + u[1]; });
  const auto found = by_cause(sums_of(e, 16));
  // In solved trials x1 is uniform on (0.1, 1). The variances are 0.81/12 and 1/12.
  EXPECT_NEAR(found.at("x1").total, 0.81 / 1.81, 5 * found.at("x1").total_se);
  EXPECT_NEAR(found.at("x2").first, 1 / 1.81, 5 * found.at("x2").first_se);
}

std::unique_ptr<ScalableExperiment> experiment_of(const std::string& rest) {
  auto plan = parse_study_plan(
      "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\n"
      "outputs = [\"EBX_urad\"]\n" +
          rest,
      MDOF_TEST_DATA "/sensitivity/plan.toml");
  EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
  auto e = make_plan_experiment(*plan);
  EXPECT_TRUE(e) << (e ? "" : e.error().message);
  return std::move(*e);
}

std::string drift(const std::string& probe, double sd) {
  return "[[quantity]]\nname = \"probe." + probe +
         ".drift_nm\"\ndistribution = \"normal\"\nsd = " + std::to_string(sd) + "\n";
}

// εy = ((B + C)/2 - A)/l is linear, so the indices are shares of the variance. A correlated group
// is one cause; its variance is the variance of its linear combination.
TEST(Sobol, CorrelatedGroupHasTheVarianceOfItsSum) {
  const auto e =
      experiment_of("[truth]\ntravel_mm = [30]\n" + drift("A", 3) + drift("B", 4) + drift("C", 5) +
                    "[[correlation]]\nquantities = [\"probe.B.drift_nm\", "
                    "\"probe.C.drift_nm\"]\nmatrix = [[1, 0.6], [0.6, 1]]\n");
  ASSERT_EQ(e->causes(),
            (std::vector<std::string>{"probe.A.drift_nm", "probe.B.drift_nm + probe.C.drift_nm"}));
  const double a = 9, group = (16 + 25 + 2 * 0.6 * 20) / 4.0;
  const auto found = by_cause(sums_of(*e, 16));
  const CauseIndex &one = found.at(e->causes()[0]), &two = found.at(e->causes()[1]);
  EXPECT_NEAR(one.first, a / (a + group), 5 * one.first_se);
  EXPECT_NEAR(one.total, a / (a + group), 5 * one.total_se);
  EXPECT_NEAR(two.first, group / (a + group), 5 * two.first_se);
  EXPECT_NEAR(two.total, group / (a + group), 5 * two.total_se);
}

// The travel is drawn in bins. Its second stream must be independent of the bin of the first
// stream.
TEST(Sobol, BinnedCauseHasCorrectIndices) {
  const std::string rest =
      "[truth]\ntravel_mm = [0, 60]\nEZX_um = [0]\n"
      "[[quantity]]\nname = \"target.top.pitch_mrad\"\ndistribution = \"constant\"\nvalue = 0.1\n" +
      drift("B", 1000);
  auto head = parse_study_plan(
      "name = \"t\"\nrig = \"../five-probe/rig_X.toml\"\n"
      "outputs = [\"EZX_um\"]\n" +
          rest + "[bins]\ncount = 20\n",
      MDOF_TEST_DATA "/sensitivity/plan.toml");
  ASSERT_TRUE(head) << head.error().message;
  const auto e = make_plan_experiment(*head).value();
  const auto found = by_cause(sums_of(*e, 16));
  // δz = 1e-4 d + B/2 (1 - d/l). With t = d/l uniform on (0, 6) this is t + b (1 - t)/2 in µm; b
  // has the standard deviation 1.
  const double travel = 3, product = (1 - 2 * 3 + 12) / 4.0;  // Var t; E (1 - t)²/4
  const double drift_first = 4 / 4.0;                         // (E (1 - t))²/4
  const CauseIndex &t = found.at("travel_mm"), &b = found.at("probe.B.drift_nm");
  EXPECT_NEAR(t.first, travel / (travel + product), 5 * t.first_se);
  EXPECT_NEAR(b.first, drift_first / (travel + product), 5 * b.first_se);
  EXPECT_NEAR(b.total, product / (travel + product), 5 * b.total_se);
}

TEST(Sobol, EachProbeCanBeACause) {
  const auto e =
      experiment_of("[truth]\ntravel_mm = [30]\n[indices]\neach_probe = true\n" + drift("*", 3));
  ASSERT_EQ(e->causes().size(), 5U);
  const auto found = by_cause(sums_of(*e, 8));
  const CauseIndex& a = found.at("probe.A.drift_nm");
  EXPECT_NEAR(a.first, 1 / 1.5, 5 * a.first_se);
  EXPECT_NEAR(found.at("probe.D.drift_nm").total, 0, 1e-12);
}

}  // namespace
}  // namespace mdof::algo
