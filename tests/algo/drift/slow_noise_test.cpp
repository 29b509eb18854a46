// A drift in correlated noise is compared with generalised least squares. The test forms the whole
// covariance matrix of the visits, which the program does not form. The Legendre polynomials are
// calculated by their closed forms.
#include "algo/drift/slow_noise.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "algo/drift/drift_design.h"

namespace mdof::algo {
namespace {

// Correlation times: 1, 2, 4 ... times the mean interval between visits, up to eight times the
// length of the log.
// Ratios of the variance of slow noise to that of white noise: 1/4, 1, 4 and more.
TEST(SlowNoises, RangeFromWhiteNoiseToRandomWalk) {
  const std::vector<SlowNoise> all = slow_noises({2, 3, 20, 22});
  ASSERT_EQ(all.size(), 1 + 5 * 5u);
  EXPECT_EQ(all[0].share, 0);
  EXPECT_EQ(all[0].correlation_s, 0);
  const double apart = 20 / 3.0, steps[] = {1, 2, 4, 8, 16}, by_white[] = {0.25, 1, 4, 16, 256};
  for (std::size_t s = 0; s < 5; ++s)
    for (std::size_t w = 0; w < 5; ++w) {
      const SlowNoise& noise = all[1 + 5 * s + w];
      EXPECT_NEAR(noise.correlation_s, steps[s] * apart, 1e-12);
      const double ratio = by_white[w] * (steps[s] > 4 ? steps[s] / 4 : 1);
      EXPECT_NEAR(noise.share / (1 - noise.share), ratio, 1e-9 * ratio);
    }
}

// The longest correlation time is at most eight times the length of the log.
TEST(SlowNoises, CorrelationTimesReachEightLogLengths) {
  // 1, 2, 4, 8 times the interval; the log is 1 interval.
  EXPECT_EQ(slow_noises({0, 1}).size(), 1 + 4 * 5u);
  // Up to 16 times the interval; the log is 2 intervals.
  EXPECT_EQ(slow_noises({0, 1, 2}).size(), 1 + 5 * 5u);
}

DriftRows uneven_rows() {
  DriftRows rows;
  rows.places = 3;
  rows.time_s = {0, 1, 3, 4.5, 5, 7, 10, 11, 14, 15, 18, 20};
  rows.place = {0, 1, 2, 2, 1, 0, 0, 1, 2, 2, 1, 0};
  rows.polynomials.resize(12, 2);
  rows.y.resize(12, 2);
  for (Eigen::Index i = 0; i < 12; ++i) {
    const double t = rows.time_s[static_cast<std::size_t>(i)] / 10 - 1;
    rows.polynomials.row(i) << t, 1.5 * t * t - 0.5;
    rows.y.row(i) << 0.7 * t + std::sin(3.0 * static_cast<double>(i)),
        2 - t * t + 0.3 * std::cos(5.0 * static_cast<double>(i));
  }
  return rows;
}

TEST(WeighedFitByMatrices, EqualsGeneralisedLeastSquares) {
  const DriftRows rows = uneven_rows();
  EXPECT_EQ(rows.freedom(), 12 - 2 - 3);
  Eigen::MatrixXd X = Eigen::MatrixXd::Zero(12, 5);
  for (std::size_t i = 0; i < 12; ++i)
    X(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(rows.place[i])) = 1;
  X.rightCols(2) = rows.polynomials;
  for (const SlowNoise& noise :
       {SlowNoise{0, 0}, SlowNoise{2, 0.3}, SlowNoise{15, 0.9}, SlowNoise{160, 0.99}}) {
    Eigen::MatrixXd V = (1 - noise.share) * Eigen::MatrixXd::Identity(12, 12);
    for (std::size_t i = 0; i < 12 && noise.share > 0; ++i)
      for (std::size_t j = 0; j < 12; ++j)
        V(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) +=
            noise.share *
            std::exp(-std::abs(rows.time_s[i] - rows.time_s[j]) / noise.correlation_s);
    const Eigen::MatrixXd inverse = V.inverse(), normal = X.transpose() * inverse * X;
    const Eigen::MatrixXd beta = normal.inverse() * X.transpose() * inverse * rows.y;
    const Eigen::MatrixXd off = rows.y - X * beta, left = off.transpose() * inverse * off;
    const Eigen::MatrixXd covariance = normal.inverse();
    const WeighedFit fit = weighed_fit(rows, noise);
    ASSERT_TRUE(fit.solved);
    EXPECT_EQ(fit.noise.share, noise.share);
    EXPECT_NEAR((fit.left - left).norm(), 0, 1e-9);
    EXPECT_NEAR(fit.log_determinants, std::log(V.determinant()) + std::log(normal.determinant()),
                1e-9);
    for (const double a : {1.0, -0.4}) {
      Eigen::VectorXd p(2);
      p << a, 0.3;
      const Eigen::VectorXd shapes = fit.shapes(p);
      for (Eigen::Index k = 0; k < 2; ++k)
        EXPECT_NEAR(shapes.dot(fit.scores.col(k)), p.dot(beta.col(k).tail(2)), 1e-9);
      EXPECT_NEAR(shapes.squaredNorm(), p.dot(covariance.bottomRightCorner(2, 2) * p), 1e-9);
    }
    for (Eigen::Index k = 0; k < 2; ++k) {
      const double likelihood =
          std::log(V.determinant()) + std::log(normal.determinant()) + 7 * std::log(left(k, k) / 7);
      EXPECT_NEAR(fit.minus_two_log_likelihood(k, 7, 0), likelihood, 1e-8);
      EXPECT_NEAR(fit.minus_two_log_likelihood(k, 7, 100), fit.log_determinants + 7 * std::log(100),
                  1e-8);
    }
  }
}

// A column of zeros makes the system singular, so it has no solution.
TEST(WeighedFitByMatrices, IsNotSolvedWithAZeroColumn) {
  DriftRows rows = uneven_rows();
  rows.polynomials.col(1).setZero();
  EXPECT_FALSE(weighed_fit(rows, {2, 0.3}).solved);
}

// Each run visits all places in the direction opposite to the run before, and takes more time than
// the run before.
std::vector<TimedVisit> many_visits(std::size_t places, int runs) {
  std::vector<TimedVisit> visits;
  double time_s = 50;
  for (int run = 0; run < runs; ++run)
    for (std::size_t i = 0; i < places; ++i)
      visits.push_back({run % 2 == 0 ? i : places - 1 - i, time_s += 2 + run});
  return visits;
}

double closed_form_legendre(int order, double x) {
  const double x2 = x * x;
  switch (order) {
    case 1:
      return x;
    case 2:
      return (3 * x2 - 1) / 2;
    case 3:
      return x * (5 * x2 - 3) / 2;
    case 4:
      return ((35 * x2 - 30) * x2 + 3) / 8;
    case 5:
      return x * ((63 * x2 - 70) * x2 + 15) / 8;
    default:
      return (((231 * x2 - 315) * x2 + 105) * x2 - 5) / 16;
  }
}

TEST(DriftDesignByHand, PolynomialsAreLegendreFromTheFirstVisit) {
  const DriftDesign design(many_visits(6, 12));
  ASSERT_EQ(design.orders(), 6);
  EXPECT_EQ(design.begin_s(), 52);
  const double end = 50 + 6 * (2 * 12 + 66);
  EXPECT_EQ(design.end_s(), end);
  for (const double share : {-0.1, 0.0, 0.2, 0.5, 0.8, 1.0, 1.5}) {
    const Eigen::VectorXd found = design.polynomials(52 + share * (end - 52));
    ASSERT_EQ(found.size(), 6);
    const double x = 2 * std::min(std::max(share, 0.0), 1.0) - 1;
    for (int k = 1; k <= 6; ++k)
      EXPECT_NEAR(found(k - 1), closed_form_legendre(k, x) - (k % 2 == 0 ? 1 : -1), 1e-9);
  }
}

// Rows are in the order of time. The mean of the rows of a place is subtracted from each of them.
TEST(DriftDesignByHand, RowsAreRelativeToTheMeanOfTheirPlace) {
  std::vector<TimedVisit> visits = many_visits(3, 8);
  std::swap(visits[1], visits[9]);
  const DriftDesign design(visits);
  ASSERT_GT(design.orders(), 0);
  Eigen::MatrixXd y(24, 2);
  for (Eigen::Index i = 0; i < 24; ++i) y.row(i) << std::sin(2.0 * static_cast<double>(i)), i * i;
  const DriftRows rows = design.rows(y);
  EXPECT_EQ(rows.places, 3u);
  ASSERT_EQ(rows.place.size(), 24u);
  for (std::size_t r = 0; r < 24; ++r) {
    if (r > 0) {
      EXPECT_LT(rows.time_s[r - 1], rows.time_s[r]);
    }
    std::size_t visit = 0;
    while (visits[visit].time_s != rows.time_s[r]) ++visit;
    EXPECT_EQ(rows.place[r], visits[visit].place);
    Eigen::RowVectorXd mean = Eigen::RowVectorXd::Zero(2);
    Eigen::RowVectorXd order_means = Eigen::RowVectorXd::Zero(design.orders());
    for (std::size_t i = 0; i < 24; ++i)
      if (visits[i].place == visits[visit].place) {
        mean += y.row(static_cast<Eigen::Index>(i)) / 8;
        order_means += design.polynomials(visits[i].time_s).transpose() / 8;
      }
    const auto row = static_cast<Eigen::Index>(r);
    EXPECT_NEAR((rows.y.row(row) - (y.row(static_cast<Eigen::Index>(visit)) - mean)).norm(), 0,
                1e-10);
    EXPECT_NEAR((rows.polynomials.row(row) -
                 (design.polynomials(visits[visit].time_s).transpose() - order_means))
                    .norm(),
                0, 1e-10);
  }
  EXPECT_EQ(rows.freedom(), 24 - 3 - design.orders());
}

// From 49 places on, two neighbouring visits share a row; from 97 places on, three visits. The row
// is the mean of consecutive visits.
TEST(DriftDesignByHand, NeighboursOfManyPlacesShareARow) {
  for (const auto& [places, each] : {std::pair(48u, 1u), std::pair(49u, 2u), std::pair(97u, 3u)}) {
    const DriftDesign design(many_visits(places, 2));
    ASSERT_GT(design.orders(), 0) << places;
    Eigen::MatrixXd y(2 * places, 1);
    for (Eigen::Index i = 0; i < y.rows(); ++i) y(i, 0) = static_cast<double>(i * i % 17);
    const DriftRows rows = design.rows(y);
    const std::size_t of_run = (places + each - 1) / each;
    EXPECT_EQ(rows.places, of_run);
    // If neighbours share a row, the two visits of the last place at the reversal are in one row.
    ASSERT_EQ(rows.place.size(), 2 * of_run - (each > 1 ? 1 : 0));
    EXPECT_EQ(rows.place[1], 1u);
    EXPECT_EQ(rows.place.back(), 0u);
    EXPECT_NEAR(rows.time_s[0], 52 + (each - 1.0), 1e-9);
    double expected = 0;
    for (std::size_t i = 0; i < each; ++i) {
      const double first = y(static_cast<Eigen::Index>(i), 0),
                   again = y(static_cast<Eigen::Index>(2 * places - 1 - i), 0);
      expected += (first - (first + again) / 2) / each;
    }
    EXPECT_NEAR(rows.y(0, 0), expected, 1e-9) << places;
  }
}

// Differences between places are not drift. An order is used if at least 2 % of its variance is
// between visits of the same place.
TEST(DriftDesignByHand, FreedomIsVisitsLessPlacesAndOrders) {
  const auto orders = [](std::size_t places, int runs) {
    return DriftDesign(many_visits(places, runs)).orders();
  };
  // One place with repeated visits. An order is used if at least four degrees of freedom remain.
  EXPECT_EQ(orders(1, 5), 0);
  EXPECT_EQ(orders(1, 6), 1);
  EXPECT_EQ(orders(1, 7), 2);
  EXPECT_EQ(orders(1, 11), 6);
  EXPECT_EQ(orders(1, 20), 6);
  EXPECT_EQ(DriftDesign(many_visits(1, 11)).freedom(), 11 - 1 - 6);
  EXPECT_EQ(DriftDesign(many_visits(1, 6)).freedom(), 4);
  EXPECT_EQ(DriftDesign(many_visits(1, 5)).freedom(), 0);  // no order is used
}

}  // namespace
}  // namespace mdof::algo
