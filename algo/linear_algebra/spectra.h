// Singular values and eigenvalues of matrices of any size, compiled in one place as least_squares.h
// says.
#pragma once

#include <Eigen/Core>

namespace mdof::algo {

// A = U diag(values) Vᵀ by Jacobi's rotations, which keep the small values accurate (Golub, Van
// Loan, Matrix Computations, 4th ed., 8.6.3). Made for tens of columns: the time grows with their
// cube.
struct SingularValues {
  Eigen::VectorXd values;  // descending, as many as the smaller side of A
  Eigen::MatrixXd U;       // a column a value
  Eigen::MatrixXd V;       // square: the columns beyond the values too, which A sends to 0
};
SingularValues singular_values(const Eigen::MatrixXd& A);

// Ascending. Of `symmetric` the lower triangle is read.
Eigen::VectorXd symmetric_eigenvalues(const Eigen::MatrixXd& symmetric);

}  // namespace mdof::algo
