#include "algo/uncertainty/statistics/independent_parts.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kLeftOver = 1e-10;  // relative to the largest variance: smaller remaining
                                     // variances are ignored

std::size_t index(Eigen::Index i) {
  return static_cast<std::size_t>(i);
}

}  // namespace

Eigen::MatrixXd independent_parts(std::size_t quantities,
                                  const std::function<double(std::size_t, std::size_t)>& covariance,
                                  std::size_t most) {
  const auto n = static_cast<Eigen::Index>(quantities);
  const auto most_parts = std::min(n, static_cast<Eigen::Index>(most));
  Eigen::VectorXd variance(n);
  for (Eigen::Index i = 0; i < n; ++i) variance(i) = covariance(index(i), index(i));
  Eigen::VectorXd left = variance;
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(n, most_parts);
  const double enough = n > 0 ? kLeftOver * variance.maxCoeff() : 0;
  Eigen::Index parts = 0;
  for (; parts < most_parts; ++parts) {
    Eigen::Index pivot = 0;
    if (!(left.maxCoeff(&pivot) > enough)) break;
    auto part = rows.col(parts);
    for (Eigen::Index i = 0; i < n; ++i) part(i) = covariance(index(i), index(pivot));
    for (Eigen::Index c = 0; c < parts; ++c) part -= rows(pivot, c) * rows.col(c);
    part /= std::sqrt(left(pivot));
    for (Eigen::Index i = 0; i < n; ++i) left(i) = std::max(0.0, left(i) - part(i) * part(i));
    left(pivot) = 0;
  }
  rows.conservativeResize(n, parts);
  if (parts == static_cast<Eigen::Index>(most))
    for (Eigen::Index i = 0; i < n; ++i)
      if (variance(i) > left(i)) rows.row(i) *= std::sqrt(variance(i) / (variance(i) - left(i)));
  return rows;
}

std::vector<std::vector<Errors5>> combined(const Eigen::MatrixXd& rows,
                                           const std::vector<std::vector<Errors5>>& alone) {
  std::vector<std::vector<Errors5>> parts(static_cast<std::size_t>(rows.cols()));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    parts[p].resize(alone.front().size());
    for (std::size_t i = 0; i < alone.size(); ++i) {
      const double of_this = rows(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(p));
      for (std::size_t j = 0; of_this != 0 && j < parts[p].size(); ++j)
        for (std::size_t e = 0; e < kErrorCount; ++e) parts[p][j][e] += of_this * alone[i][j][e];
    }
  }
  return parts;
}

}  // namespace mdof::algo
