#include "algo/sensitivity/correlation.h"

#include <Eigen/Cholesky>
#include <array>
#include <cstdio>
#include <string>

#include "algo/linear_algebra/spectra.h"

namespace mdof::algo {
namespace {

constexpr double kLeastEigenvalue = 1e-10;  // with a smaller eigenvalue, rounding decides whether
                                            // the factor exists

tl::unexpected<Error> not_positive_definite(const PlannedCorrelation& group, double smallest) {
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%.3g", smallest);
  std::string names;
  for (const auto& name : group.quantities) names += (names.empty() ? "" : ", ") + name;
  return bad_input(group.where + ": the correlation matrix of " + names +
                   " is not positive definite (its smallest eigenvalue is " + number.data() +
                   "), so no random numbers can have these correlations; reduce the coefficients");
}

}  // namespace

Result<std::vector<double>> cholesky_factor(const PlannedCorrelation& group) {
  const auto n = static_cast<Eigen::Index>(group.quantities.size());
  const Eigen::MatrixXd matrix =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
          group.matrix.data(), n, n);
  const double smallest = symmetric_eigenvalues(matrix).minCoeff();
  const Eigen::LLT<Eigen::MatrixXd> llt(matrix);
  if (llt.info() != Eigen::Success || smallest < kLeastEigenvalue)
    return not_positive_definite(group, smallest);
  const Eigen::MatrixXd L = llt.matrixL();
  std::vector<double> factor(group.matrix.size(), 0.0);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) factor[static_cast<std::size_t>(i * n + j)] = L(i, j);
  }
  return factor;
}

}  // namespace mdof::algo
