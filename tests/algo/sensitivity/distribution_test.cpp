// Quantiles and special functions are compared with values from 30-digit arithmetic, moments with
// JCGM 101.
#include "algo/sensitivity/distribution.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/sensitivity/correlation.h"
#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

using Kind = Distribution::Kind;

Distribution limited(Kind kind, double low, double high) {
  Distribution d;
  d.kind = kind;
  d.low = low;
  d.high = high;
  d.mode = (low + high) / 2;
  return d;
}

Distribution student(double dof, double centre = 0, double scale = 1) {
  Distribution d;
  d.kind = Kind::t;
  d.dof = dof;
  d.centre = centre;
  d.spread = scale;
  return d;
}

struct Moments {
  double mean, sd;
};

// Moments that are calculated from the middles of n intervals of equal probability.
Moments moments_of(const Distribution& d, int n = 1'000'000) {
  const QuantileFunction q(d);
  double sum = 0, squares = 0;
  for (int i = 0; i < n; ++i) {
    const double x = q.at((i + 0.5) / n);
    sum += x;
    squares += x * x;
  }
  const double mean = sum / n;
  return {mean, std::sqrt(squares / n - mean * mean)};
}

TEST(PlanFunctions, MatchTheTables) {
  const double cdf[][2] = {{0, 0.5},
                           {-8, 6.2209605742717841e-16},
                           {-5, 2.8665157187919391e-7},
                           {-3.5, 2.3262907903552504e-4},
                           {-2.9, 1.8658133003840380e-3},
                           {-1, 0.15865525393145705},
                           {0.3, 0.61791142218895264},
                           {2, 0.97724986805182079}};
  for (const auto& [z, p] : cdf) EXPECT_NEAR(normal_cdf(z) / p, 1, 2e-13) << z;
  const double gamma[][2] = {{0.5, 0.57236494292470009},
                             {1.5, -0.12078223763524522},
                             {3.25, 0.93580193110872536},
                             {20, 39.339884187199494},
                             {5000, 37582.62631568535}};
  for (const auto& [x, value] : gamma)
    EXPECT_NEAR(log_gamma(x), value, 1e-14 * (1 + std::abs(value))) << x;
  // ln 14! and ln 15!, to the last digits of a double. Here the series has the fewest terms.
  EXPECT_NEAR(log_gamma(15), 25.191221182738681500, 1.5e-14);
  EXPECT_NEAR(log_gamma(16), 27.899271383840891566, 1.5e-14);
  for (const double x : {1e-300, 1e-5, 0.7, 0.999999, 1.0, 1.5, 3.0, 1e10, 1e300})
    EXPECT_NEAR(natural_log(x), std::log(x), 1e-15 * (1 + std::abs(std::log(x)))) << x;
  for (const double x : {-699.5, -20.0, -1.0, -1e-9, 0.0, 0.3, 1.0, 50.0, 699.0})
    EXPECT_NEAR(exponential(x) / std::exp(x), 1, 1e-15 * (2 + std::abs(x) / 100)) << x;
  EXPECT_EQ(exponential(-1000), 0);
}

TEST(StudentT, QuantilesMatchTheTables) {
  const double rows[][3] = {
      {1, 0.6, 0.32491969623290633},       {1, 0.975, 12.706204736174705},
      {1, 0.999999, 318309.88618274347},   {1, 0.999999999, 318309886.18379067},
      {2, 0.6, 0.28867513459481288},       {2, 0.975, 4.3026527297494639},
      {2, 0.999999, 707.1057205259338},    {2, 0.999999999, 22360.679741456877},
      {2.5, 0.6, 0.28145951274854766},     {2.5, 0.975, 3.5746548420036832},
      {2.5, 0.999999, 220.17342917823684}, {2.5, 0.999999999, 3489.5833953699818},
      {5, 0.6, 0.26718086570414513},       {5, 0.975, 2.5705818356363155},
      {5, 0.999999, 24.771029720515944},   {5, 0.999999999, 98.937224648369957},
      {9, 0.975, 2.2621571627982055},      {30, 0.6, 0.25560536495191277},
      {30, 0.975, 2.0422724563012383},     {30, 0.999999999, 8.4458627962742428},
      {200, 0.999999, 4.8973021028267818}, {10000, 0.6, 0.25335384344572685},
      {10000, 0.975, 1.9602012398906263},  {10000, 0.999999999, 6.0033554479471416},
  };
  for (const auto& [dof, p, x] : rows) {
    // For p = 1 - q near 1, a double represents q only with an error of 1e-16. The error of x is
    // this error times the slope.
    const double by_p = 1e-16 / (1 - p);
    const QuantileFunction q(student(dof, 5, 2));
    EXPECT_NEAR((q.at(p) - 5) / 2 / x, 1, 1e-8 + by_p) << dof << " " << p;
    EXPECT_NEAR((5 - q.at(1 - p)) / 2 / x, 1, 1e-8 + by_p) << dof << " " << p;
    EXPECT_NEAR(t_upper_tail(x, dof) / (1 - p), 1, 1e-11 + by_p) << dof << " " << p;
  }
}

TEST(StudentT, IsAccurateBetweenItsNodes) {
  for (const double dof : {1.0, 2.0, 4.0, 50.0}) {
    const QuantileFunction q(student(dof));
    for (double z = 0.001; z < 8; z += 0.0137) {
      const double tail = normal_cdf(-z);
      EXPECT_NEAR(t_upper_tail(q.at_score(z), dof) / tail, 1, 2e-8 * dof) << dof << " " << z;
    }
  }
}

TEST(StudentT, HasTheStandardDeviationOfJcgm101) {
  const Moments m = moments_of(student(9, 1, 3));
  EXPECT_NEAR(m.mean, 1, 1e-6);
  EXPECT_NEAR(m.sd, 3 * std::sqrt(9.0 / 7), 1e-3);
}

TEST(Distribution, LimitedDistributionsHaveTheirMomentsAndEnds) {
  const double a = 2, b = 8, half = 3, mean = 5;
  Distribution trapezoid = limited(Kind::trapezoidal, a, b);
  trapezoid.beta = 0.4;
  const std::pair<Distribution, double> cases[] = {
      {limited(Kind::rectangular, a, b), half / std::sqrt(3.0)},
      {limited(Kind::triangular, a, b), half / std::sqrt(6.0)},
      {trapezoid, half * std::sqrt((1 + 0.4 * 0.4) / 6)},  // standard deviation by JCGM 101 §6.4.4
      {limited(Kind::u_shaped, a, b), half / std::sqrt(2.0)},
  };
  for (const auto& [d, sd] : cases) {
    const QuantileFunction q(d);
    const Moments m = moments_of(d);
    EXPECT_NEAR(m.mean, mean, 1e-9) << to_string(d.kind);
    EXPECT_NEAR(m.sd, sd, 1e-5) << to_string(d.kind);
    EXPECT_NEAR(q.at(0x1p-53), a, 1e-6);
    EXPECT_NEAR(q.at(1 - 0x1p-53), b, 1e-6);
    EXPECT_EQ(q.size(), b);
    for (double p = 0.01; p < 0.985; p += 0.01) EXPECT_LT(q.at(p), q.at(p + 0.01));
  }
}

TEST(Distribution, TriangleMayBeAsymmetric) {
  Distribution d = limited(Kind::triangular, 0, 4);
  d.mode = 0;
  const QuantileFunction q(d);
  EXPECT_DOUBLE_EQ(q.at(0.75), 2);  // 1 - (1 - x/4)² = 3/4 for x = 2
  EXPECT_NEAR(moments_of(d).mean, 4.0 / 3, 1e-6);
}

TEST(Distribution, NormalIsEqualByProbabilityAndScore) {
  Distribution d;
  d.kind = Kind::normal;
  d.centre = 1;
  d.spread = 2;
  const QuantileFunction q(d);
  EXPECT_NEAR(q.at(0.975), 1 + 2 * 1.9599639845400543, 1e-14);
  EXPECT_EQ(q.at_score(1.5), 4);
  EXPECT_EQ(q.size(), 2);
  const QuantileFunction r(limited(Kind::rectangular, 0, 1));
  EXPECT_NEAR(r.at_score(1), 0.84134474606854293, 1e-14);
}

TEST(Distribution, EmpiricalInterpolatesBetweenItsValues) {
  Distribution d;
  d.kind = Kind::empirical;
  d.sample = {-3, 1, 2, 10};
  const QuantileFunction q(d);
  EXPECT_EQ(q.at(0.01), -3);
  EXPECT_EQ(q.at(0.125), -3);
  EXPECT_DOUBLE_EQ(q.at(0.25), -1);
  EXPECT_DOUBLE_EQ(q.at(0.5), 1.5);
  EXPECT_DOUBLE_EQ(q.at(0.75), 6);
  EXPECT_EQ(q.at(0.99), 10);
  EXPECT_EQ(q.size(), 10);
}

TEST(Correlation, FactorReproducesTheMatrix) {
  const PlannedCorrelation group{{"a", "b", "c"}, {1, 0.5, -0.2, 0.5, 1, 0.3, -0.2, 0.3, 1}, ""};
  const auto L = cholesky_factor(group).value();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < 3; ++k) sum += L[i * 3 + k] * L[j * 3 + k];
      EXPECT_NEAR(sum, group.matrix[i * 3 + j], 1e-15);
    }
  }
}

TEST(Correlation, RejectsAnIndefiniteMatrixWithItsEigenvalue) {
  // The eigenvalues are 1.9, 1.9 and -0.8, so the matrix is invalid: three quantities cannot all
  // have correlations of -0.9 with each other.
  const PlannedCorrelation group{{"a", "b", "c"},
                                 {1, -0.9, -0.9, -0.9, 1, -0.9, -0.9, -0.9, 1},
                                 "plan.toml:7: correlation[1].quantities"};
  const auto L = cholesky_factor(group);
  ASSERT_FALSE(L);
  EXPECT_NE(L.error().message.find("plan.toml:7"), std::string::npos) << L.error().message;
  EXPECT_NE(L.error().message.find("a, b, c is not positive definite"), std::string::npos);
  EXPECT_NE(L.error().message.find("-0.8"), std::string::npos) << L.error().message;
}

}  // namespace
}  // namespace mdof::algo
