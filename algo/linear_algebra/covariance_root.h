// Root of a covariance matrix, for independent parts of an uncertainty.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace mdof::algo {

// Returns the lower triangle L with L Lᵀ = covariance (Cholesky's method). A pivot that is only
// rounding is taken as 0. Each element is limited to the remaining variance, because rounding can
// make the covariance indefinite.
template <class Matrix>
Matrix covariance_root(const Matrix& covariance) {
  constexpr double kNothing = 1e-12;  // a pivot below this share of the variance is rounding
  Matrix L = Matrix::Zero(covariance.rows(), covariance.cols());
  const auto left = [&](Eigen::Index k, Eigen::Index q) {
    return covariance(k, k) - L.row(k).head(q).squaredNorm();
  };
  for (Eigen::Index q = 0; q < L.rows(); ++q) {
    const double pivot = left(q, q);
    if (!(pivot > kNothing * covariance(q, q))) continue;
    L(q, q) = std::sqrt(pivot);
    for (Eigen::Index k = q + 1; k < L.rows(); ++k) {
      const double most = std::sqrt(std::max(0.0, left(k, q)));
      const double part = (covariance(k, q) - L.row(k).head(q).dot(L.row(q).head(q))) / L(q, q);
      L(k, q) = std::clamp(part, -most, most);
    }
  }
  return L;
}

}  // namespace mdof::algo
