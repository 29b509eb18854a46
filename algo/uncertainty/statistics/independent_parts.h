// Correlated quantities as sums of independent parts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "schema/axis.h"

namespace mdof::algo {

// The product of row i with itself is the variance of quantity i; the product of rows i and j is
// their covariance. Cholesky's decomposition with pivoting (Higham, Accuracy and Stability of
// Numerical Algorithms, 10.3) ends where no remaining variance is above 1e-10 of the largest. It
// gives at most `most` columns; if they are not enough, the rows are scaled to their variance.
Eigen::MatrixXd independent_parts(std::size_t quantities,
                                  const std::function<double(std::size_t, std::size_t)>& covariance,
                                  std::size_t most);

// Effect of each independent part on the points: [part][point]. `alone`: effect of one unit of each
// quantity alone: [quantity][point].
std::vector<std::vector<Errors5>> combined(const Eigen::MatrixXd& rows,
                                           const std::vector<std::vector<Errors5>>& alone);

}  // namespace mdof::algo
