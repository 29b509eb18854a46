// Singular values and eigenvalues of matrices of any size. As for least_squares.h, only one file
// instantiates Eigen's templates.
#pragma once

#include <Eigen/Core>

namespace mdof::algo {

// A = U diag(values) Vᵀ, calculated by Jacobi rotations, because these calculate small values
// accurately (Golub, Van Loan, Matrix Computations, 4th ed., 8.6.3). Suitable for tens of columns:
// the calculation time grows with the cube of the number of columns.
struct SingularValues {
  Eigen::VectorXd values;  // descending; as many as the smaller dimension of A
  Eigen::MatrixXd U;       // one column for each value
  Eigen::MatrixXd V;       // square; A maps the columns beyond the values to 0
};
SingularValues singular_values(const Eigen::MatrixXd& A);

// Returns the eigenvalues in ascending order. Reads only the lower triangle of `symmetric`.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace mdof::algo
