#include "algo/part/measured_square.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kLeastSquare = 1e-12;  // relative to the largest; smaller ones are due to rounding
constexpr double kSizeStep = 0.85;
constexpr int kSizeSteps = 80, kSizeHalvings = 32;

}  // namespace

MeasuredSquare::MeasuredSquare(const Eigen::MatrixXd& effects, const Eigen::VectorXd& with_value)
    : basis_(effects.rows(), 0) {
  if (effects.rows() == 0) return;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(effects);
  const Eigen::VectorXd& all = eigen.eigenvalues();  // in increasing order
  const double largest = all(all.size() - 1);
  if (!(largest > 0)) return;
  const auto rank = (all.array() > kLeastSquare * largest).count();
  basis_ = eigen.eigenvectors().rightCols(rank);
  squares_ = all.tail(rank);
  value_ = (basis_.transpose() * with_value).cwiseQuotient(squares_);
}

// The point with a certain mean square that is nearest to `way` by the uncertainty. size: factor of
// the direction with the largest u; 1: `way` itself.
Eigen::VectorXd MeasuredSquare::shrunk(const Eigen::VectorXd& way, double size) const {
  const Eigen::ArrayXd relative = squares_.array() / squares_(squares_.size() - 1);
  return way.array() * (size / (size + (1 - size) * relative));
}

Eigen::VectorXd MeasuredSquare::drawn_truth(const Eigen::VectorXd& xi,
                                            const Eigen::VectorXd& turn) const {
  if (squares_.size() == 0) return Eigen::VectorXd::Zero(effects());
  const Eigen::VectorXd error = basis_.transpose() * xi, way = value_ + basis_.transpose() * turn;
  const double measured = squares_.dot(value_.cwiseAbs2());
  const auto excess = [&](double size) {
    return squares_.dot((shrunk(way, size) - error).cwiseAbs2()) - measured;
  };
  const Eigen::Index top = squares_.size() - 1;
  const double at_most = (std::abs(error(top)) + std::sqrt(measured / squares_(top))) /
                         std::max(std::abs(way(top)), 1e-9);
  double above = at_most, least = excess(0), size_of_least = 0;
  for (int step = 0; step < kSizeSteps; ++step) {
    const double size = at_most * std::pow(kSizeStep, step), more = excess(size);
    if (more <= 0) {
      double below = size;
      for (int k = 0; k < kSizeHalvings; ++k) {
        const double middle = (below + above) / 2;
        (excess(middle) > 0 ? above : below) = middle;
      }
      return basis_ * shrunk(way, below);
    }
    above = size;
    if (more < least) {
      least = more;
      size_of_least = size;
    }
  }
  return basis_ * shrunk(way, size_of_least);
}

}  // namespace mdof::algo
