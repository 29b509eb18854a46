// Linear equations of any size, solved by least squares. Eigen's templates cost the compiler
// several seconds in each file that instantiates them, so only least_squares.cpp does.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace mdof::algo {

// Solves A x = b if the columns of A are independent: QR by Householder reflections with column
// pivoting (Golub, Van Loan, Matrix Computations, 4th ed., 5.4.2). A column whose pivot is at most
// `rank_tolerance` times the largest pivot counts as dependent, and its unknown is 0. The default
// tolerance is that of rounding.
class LeastSquares {
 public:
  explicit LeastSquares(const Eigen::MatrixXd& A);
  LeastSquares(const Eigen::MatrixXd& A, double rank_tolerance);
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;

  Eigen::Index rank() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd basis() const;  // orthonormal columns: the span of the columns of A

 private:
  std::unique_ptr<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> qr_;
};

// Solves A x = b if A may not determine all of x: the least-squares solution with the smallest
// norm, by a complete orthogonal decomposition (ibid., 5.5.2).
class LeastNorm {
 public:
  explicit LeastNorm(const Eigen::MatrixXd& A);
  LeastNorm(const Eigen::MatrixXd& A, double rank_tolerance);
  ~LeastNorm();
  LeastNorm(LeastNorm&&) noexcept;

  Eigen::Index unknowns() const;
  Eigen::Index rank() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd inverse() const;  // pseudo-inverse: x = inverse() b
  // Orthonormal columns: the part of x that A does not determine.
  Eigen::MatrixXd null_space() const;

 private:
  std::unique_ptr<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> cod_;
};

// A = Q R, where Q has orthonormal columns and the size of A, and R is upper triangular. A has at
// least as many rows as columns.
struct ThinQr {
  Eigen::MatrixXd Q, R;
};
ThinQr thin_qr(const Eigen::MatrixXd& A);

}  // namespace mdof::algo
