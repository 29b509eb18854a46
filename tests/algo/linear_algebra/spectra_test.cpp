#include "algo/linear_algebra/spectra.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::algo {
namespace {

using Eigen::MatrixXd;

// Calculated by hand: for A = [[3, 0], [4, 5]], A Aᵀ has the eigenvalues 45 and 5.
TEST(SingularValues, MatchTheTextbook) {
  const MatrixXd A{{3.0, 0.0}, {4.0, 5.0}};
  const auto svd = singular_values(A);
  EXPECT_NEAR(svd.values(0), std::sqrt(45.0), 1e-14);
  EXPECT_NEAR(svd.values(1), std::sqrt(5.0), 1e-14);
  EXPECT_LT((svd.U * svd.values.asDiagonal() * svd.V.transpose() - A).norm(), 1e-14);
}

TEST(SingularValues, MatrixVIncludesTheNullSpace) {
  const MatrixXd A{{1.0, 2.0, 2.0}};
  const auto svd = singular_values(A);
  ASSERT_EQ(svd.values.size(), 1);
  EXPECT_NEAR(svd.values(0), 3, 1e-14);
  ASSERT_EQ(svd.V.cols(), 3);
  EXPECT_LT((A * svd.V.rightCols(2)).norm(), 1e-14);
}

TEST(SymmetricEigenvalues, AreAscending) {
  const auto values = symmetric_eigenvalues(MatrixXd{{2.0, 1.0}, {1.0, 2.0}});
  EXPECT_NEAR(values(0), 1, 1e-14);
  EXPECT_NEAR(values(1), 3, 1e-14);
}

}  // namespace
}  // namespace mdof::algo
