// Linear equations of any size, solved by least squares. Eigen's templates for this cost a compiler
// several seconds wherever they stand, so they stand in least_squares.cpp alone.
#pragma once

#include <Eigen/Core>
#include <memory>

namespace mdof::algo {

// A x = b where the columns of A are independent: QR by Householder's reflections with column
// pivoting (Golub, Van Loan, Matrix Computations, 4th ed., 5.4.2). A column whose pivot is at most
// `rank_tolerance` times the largest one is taken for dependent, and its unknown is 0; the default
// is that of rounding.
class LeastSquares {
 public:
  explicit LeastSquares(const Eigen::MatrixXd& A);
  LeastSquares(const Eigen::MatrixXd& A, double rank_tolerance);
  ~LeastSquares();
  LeastSquares(LeastSquares&&) noexcept;

  Eigen::Index rank() const;
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  Eigen::MatrixXd solve(const Eigen::MatrixXd& B) const;
  Eigen::MatrixXd basis() const;  // orthonormal columns: what the columns of A span

 private:
  std::unique_ptr<Eigen::ColPivHouseholderQR<Eigen::MatrixXd>> qr_;
};

// A x = b where A may not determine all of x: of all least-squares solutions that of least norm, by
// a complete orthogonal decomposition (ibid., 5.5.2).
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
  Eigen::MatrixXd inverse() const;     // pseudo-inverse: x = inverse() b
  Eigen::MatrixXd null_space() const;  // orthonormal columns: what A does not determine of x

 private:
  std::unique_ptr<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> cod_;
};

// A = Q R, Q with orthonormal columns and as large as A, R upper triangular. A has at least as many
// rows as columns.
struct ThinQr {
  Eigen::MatrixXd Q, R;
};
ThinQr thin_qr(const Eigen::MatrixXd& A);

}  // namespace mdof::algo
