#include "algo/linear_algebra/least_squares.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

namespace mdof::algo {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd three_by_two() {
  MatrixXd A(3, 2);
  A << 1, 0, 1, 1, 1, 2;
  return A;
}

// Calculated by hand: the least-squares line of (0, 6), (1, 0), (2, 0) is 5 - 3 x.
TEST(LeastSquares, FindsTheLineOfTheTextbook) {
  const LeastSquares fit(three_by_two());
  EXPECT_EQ(fit.rank(), 2);
  const VectorXd x = fit.solve(VectorXd{{6.0, 0.0, 0.0}});
  EXPECT_NEAR(x(0), 5, 1e-14);
  EXPECT_NEAR(x(1), -3, 1e-14);
  const MatrixXd both = fit.solve(MatrixXd{{6.0, 1.0}, {0.0, 1.0}, {0.0, 1.0}});
  EXPECT_NEAR(both(1, 0), -3, 1e-14);
  EXPECT_NEAR(both(0, 1), 1, 1e-14);
}

TEST(LeastSquares, BasisSpansTheColumns) {
  const MatrixXd A = three_by_two(), Q = LeastSquares(A).basis();
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(2, 2)).norm(), 1e-14);
  EXPECT_LT((A - Q * (Q.transpose() * A)).norm(), 1e-14);
}

TEST(LeastSquares, ToleranceRemovesDependentColumns) {
  MatrixXd A(3, 3);
  A << three_by_two(), VectorXd{{1.0, 2.0, 3.0 + 1e-8}};
  EXPECT_EQ(LeastSquares(A).rank(), 3);
  const LeastSquares fit(A, 1e-6);
  EXPECT_EQ(fit.rank(), 2);
  EXPECT_EQ(fit.basis().cols(), 2);
}

// The equation x + y = 2 has the shortest solution (1, 1). It does not determine the direction (1,
// -1).
TEST(LeastNorm, GivesTheShortestSolutionAndTheNullSpace) {
  const LeastNorm fit(MatrixXd{{1.0, 1.0}, {2.0, 2.0}, {0.0, 0.0}});
  EXPECT_EQ(fit.rank(), 1);
  const VectorXd b{{2.0, 4.0, 7.0}}, x = fit.solve(b);
  EXPECT_NEAR(x(0), 1, 1e-14);
  EXPECT_NEAR(x(1), 1, 1e-14);
  EXPECT_LT((fit.inverse() * b - x).norm(), 1e-14);
  const MatrixXd null = fit.null_space();
  ASSERT_EQ(null.cols(), 1);
  EXPECT_NEAR(null(0, 0), -null(1, 0), 1e-14);
  EXPECT_NEAR(null.norm(), 1, 1e-14);
}

TEST(LeastNorm, ToleranceDeterminesTheRank) {
  const MatrixXd A{{1.0, 1.0}, {1.0, 1.0 + 1e-8}};
  EXPECT_EQ(LeastNorm(A).rank(), 2);
  EXPECT_EQ(LeastNorm(A).null_space().cols(), 0);
  EXPECT_EQ(LeastNorm(A, 1e-6).rank(), 1);
}

// Tests the four conditions of Moore and Penrose.
TEST(LeastNorm, InverseIsTheMoorePenroseInverse) {
  MatrixXd A(5, 4);
  for (Eigen::Index i = 0; i < 5; ++i)
    for (Eigen::Index j = 0; j < 4; ++j) A(i, j) = std::sin(static_cast<double>((i + 1) * (j + 1)));
  A.col(3) = A.col(0) - 2 * A.col(1);
  const LeastNorm fit(A, 1e-9);
  ASSERT_EQ(fit.rank(), 3);
  const MatrixXd B = fit.inverse();
  EXPECT_LT((A * B * A - A).norm(), 1e-13);
  EXPECT_LT((B * A * B - B).norm(), 1e-13);
  EXPECT_LT((A * B - (A * B).transpose()).norm(), 1e-13);
  EXPECT_LT((B * A - (B * A).transpose()).norm(), 1e-13);
  EXPECT_LT((A * fit.null_space()).norm(), 1e-13);
}

TEST(ThinQr, FactorsTheMatrix) {
  const MatrixXd A = three_by_two();
  const auto [Q, R] = thin_qr(A);
  EXPECT_LT((Q * R - A).norm(), 1e-14);
  EXPECT_LT((Q.transpose() * Q - MatrixXd::Identity(2, 2)).norm(), 1e-14);
  EXPECT_EQ(R(1, 0), 0);
}

}  // namespace
}  // namespace mdof::algo
