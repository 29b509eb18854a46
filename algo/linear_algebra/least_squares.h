// Solves linear equations of any size by least squares. Only least_squares.cpp instantiates Eigen's
// templates for this, because each file that instantiates them takes several seconds to compile.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace mdof::algo {

// Solves A x = b if the columns of A are independent. Method: QR decomposition with Householder
// reflections and column pivoting (Golub, Van Loan, Matrix Computations, 4th ed., 5.4.2). A column
// whose pivot is at most `rank_tolerance` times the largest pivot counts as dependent; its element
// of x is 0. The default tolerance follows from rounding errors.
class LeastSquares {
 public:
  explicit LeastSquares(const Eigen::MatrixXd& A);
  LeastSquares(const Eigen::MatrixXd& A, double rank_tolerance);
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;

  Eigen::Index rank() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd basis() const;  // orthonormal basis of the columns of A

 private:
  std::unique_ptr<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> qr_;
};

// Solves A x = b if A may not determine all elements of x. Returns the least-squares solution with
// the smallest norm. Method: complete orthogonal decomposition (ibid., 5.5.2).
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
  // Orthonormal basis of the part of x that A does not determine, as columns.
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
