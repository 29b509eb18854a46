// Singular values and eigenvalues of matrices of any size, compiled in one file as in
// least_squares.h.
#pragma once

#include <Eigen/Core>

namespace mdof::algo {

// A = U diag(values) Vᵀ by Jacobi rotations, which keep the small values accurate (Golub, Van Loan,
// Matrix Computations, 4th ed., 8.6.3). Suitable for tens of columns: the time grows with the cube
// of their number.
struct SingularValues {
  Eigen::VectorXd values;  // descending; their number is the smaller dimension of A
  Eigen::MatrixXd U;       // a column for each value
  Eigen::MatrixXd V;       // square; A maps the columns beyond the values to 0
};
SingularValues singular_values(const Eigen::MatrixXd& A);

// Ascending. Only the lower triangle of `symmetric` is read.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace mdof::algo
