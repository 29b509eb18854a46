// Correlated quantities as sums of independent parts.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <vector>

#include "schema/axis.h"

namespace mdof::algo {

// Row i times its transpose is the variance of quantity i, row i times row j their covariance. By
// Cholesky's decomposition with pivoting (Higham, Accuracy and Stability of Numerical Algorithms,
// 10.3), which ends where no variance above 1e-10 of the largest is left. At most `most` columns:
// where they are not enough, the rows are scaled to their variance.
Eigen::MatrixXd independent_parts(std::size_t quantities,
                                  const std::function<double(std::size_t, std::size_t)>& covariance,
                                  std::size_t most);

// What each independent part does to the points, of what each quantity does by one unit of it alone
// [quantity][point]: [part][point].
std::vector<std::vector<Errors5>> combined(const Eigen::MatrixXd& rows,
                                           const std::vector<std::vector<Errors5>>& alone);

}  // namespace mdof::algo
