#include "algo/linear_algebra/least_squares.h"

#include <Eigen/QR>

namespace mdof::algo {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

LeastSquares::LeastSquares(const MatrixXd& A)
    : qr_(std::make_unique<Eigen::ColPivHouseholderQR<MatrixXd>>(A)) {}
LeastSquares::LeastSquares(const MatrixXd& A, double rank_tolerance)
    : qr_(std::make_unique<Eigen::ColPivHouseholderQR<MatrixXd>>(A.rows(), A.cols())) {
  qr_->setThreshold(rank_tolerance);
  qr_->compute(A);
}
LeastSquares::~LeastSquares() = default;
LeastSquares::LeastSquares(LeastSquares&&) noexcept = default;

Index LeastSquares::rank() const {
  return qr_->rank();
}
VectorXd LeastSquares::solve(const VectorXd& b) const {
  return qr_->solve(b);
}
MatrixXd LeastSquares::solve(const MatrixXd& B) const {
  return qr_->solve(B);
}
MatrixXd LeastSquares::basis() const {
  return qr_->householderQ() * MatrixXd::Identity(qr_->rows(), qr_->rank());
}

LeastNorm::LeastNorm(const MatrixXd& A)
    : cod_(std::make_unique<Eigen::CompleteOrthogonalDecomposition<MatrixXd>>(A)) {}
LeastNorm::LeastNorm(const MatrixXd& A, double rank_tolerance)
    : cod_(std::make_unique<Eigen::CompleteOrthogonalDecomposition<MatrixXd>>(A.rows(), A.cols())) {
  cod_->setThreshold(rank_tolerance);
  cod_->compute(A);
}
LeastNorm::~LeastNorm() = default;
LeastNorm::LeastNorm(LeastNorm&&) noexcept = default;

Index LeastNorm::unknowns() const {
  return cod_->cols();
}
Index LeastNorm::rank() const {
  return cod_->rank();
}
VectorXd LeastNorm::solve(const VectorXd& b) const {
  return cod_->solve(b);
}
MatrixXd LeastNorm::solve(const MatrixXd& B) const {
  return cod_->solve(B);
}
MatrixXd LeastNorm::inverse() const {
  return cod_->solve(MatrixXd::Identity(cod_->rows(), cod_->rows()));
}

// A P = Q [T 0; 0 0] Z, so A maps the directions in the last rows of Z to 0.
MatrixXd LeastNorm::null_space() const {
  return cod_->colsPermutation() *
         cod_->matrixZ().bottomRows(cod_->cols() - cod_->rank()).transpose();
}

ThinQr thin_qr(const MatrixXd& A) {
  const Eigen::HouseholderQR<MatrixXd> qr(A);
  return {qr.householderQ() * MatrixXd::Identity(A.rows(), A.cols()),
          qr.matrixQR().topRows(A.cols()).triangularView<Eigen::Upper>()};
}

}  // namespace mdof::algo
