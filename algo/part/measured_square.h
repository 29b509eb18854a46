// The mean square of a true error along a path, from a measured error v = m + Σ ξ_q u_q. m: true
// error; u_q: effects of independent quantities of variance 1. README.md has the derivation.
#pragma once

#include <Eigen/Core>

namespace mdof::algo {

class MeasuredSquare {
 public:
  MeasuredSquare() = default;
  // `effects`: mean products ⟨u_q u_r⟩ over the points. `with_value`: ⟨v u_q⟩.
  MeasuredSquare(const Eigen::MatrixXd& effects, const Eigen::VectorXd& with_value);

  Eigen::Index effects() const { return basis_.rows(); }
  // The number of independent directions in which the effects change v.
  Eigen::Index directions() const { return squares_.size(); }
  // The part of v that is a sum of effects: the factor of each effect.
  Eigen::VectorXd value() const { return basis_ * value_; }
  // One trial for the part of m that is a sum of effects: the factor of each effect. `xi`, `turn`:
  // independent random numbers of variance 1, one for each effect.
  Eigen::VectorXd drawn_truth(const Eigen::VectorXd& xi, const Eigen::VectorXd& turn) const;

 private:
  Eigen::VectorXd shrunk(const Eigen::VectorXd& way, double size) const;

  // Orthonormal sums of the effects whose mean products are 0: the factors of the effects
  // (columns), the mean squares, and the factors of these sums in v.
  Eigen::MatrixXd basis_;
  Eigen::VectorXd squares_, value_;
};

}  // namespace mdof::algo
