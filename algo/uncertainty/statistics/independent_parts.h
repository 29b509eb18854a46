// Correlated quantities as sums of independent parts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "schema/axis.h"

namespace mdof::algo {

// Returns one row for each quantity and one column for each independent part. The scalar product of
// rows i and j is the covariance of quantities i and j. Uses Cholesky's decomposition with pivoting
// (Higham, Accuracy and Stability of Numerical Algorithms, 10.3). The decomposition ends if all
// remaining variances are below 1e-10 of the largest variance, or after `most` columns. In the
// second case each row is scaled so that its variance is correct.
Eigen::MatrixXd independent_parts(std::size_t quantities,
                                  const std::function<double(std::size_t, std::size_t)>& covariance,
                                  std::size_t most);

// Effect of each independent part on the points: [part][point]. `rows`: result of
// independent_parts(). `alone`: effect of one unit of each quantity: [quantity][point].
std::vector<std::vector<Errors5>> combined(const Eigen::MatrixXd& rows,
                                           const std::vector<std::vector<Errors5>>& alone);

}  // namespace mdof::algo
