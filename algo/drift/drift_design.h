// What repeated visits of the same places tell of a drift: y = of the place + drift(time) + noise.
//
// A place is a target with its approach: its error is the same at each visit, and so is its
// reversal. A drift is a polynomial in time (Legendre). What of it is the same at every visit of a
// place passes for the form or the slope of the axis, and is not seen; a polynomial is taken only
// as far as at least kFewestSeen of the variance of each of its combinations is seen.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mdof::algo {

struct TimedVisit {
  std::size_t place = 0;
  double time_s = 0;
};

class DriftDesign {
 public:
  static constexpr double kFewestSeen = 0.02;
  static constexpr int kMostOrders = 6, kFewestFreedom = 4;

  explicit DriftDesign(std::vector<TimedVisit> visits);

  int orders() const { return orders_; }       // 0: no drift can be told from the form of the axis
  double freedom() const { return freedom_; }  // of what the highest order leaves
  const std::vector<TimedVisit>& visits() const { return visits_; }

  // `y` (visits × series) without the means of its places.
  Eigen::MatrixXd centred(const Eigen::MatrixXd& y) const;
  // (orders × series). Each row is independent of the others and has the variance of `y`; a drift
  // of order n is shapes(t) · scores, the first n of both.
  Eigen::MatrixXd scores(const Eigen::MatrixXd& y) const;
  // What the highest order leaves of centred(y).
  Eigen::MatrixXd residuals(const Eigen::MatrixXd& y) const;
  // Their mean over all visits is 0: a drift leaves the mean of a run as it is. Before the first
  // visit they are those of the first, after the last those of the last.
  Eigen::VectorXd shapes(double time_s) const;

 private:
  Eigen::VectorXd polynomials(double time_s, int orders) const;

  std::vector<TimedVisit> visits_;
  std::vector<double> visits_of_place_;
  double begin_s_ = 0, length_s_ = 0, freedom_ = 0;
  int orders_ = 0;
  Eigen::VectorXd mean_;          // of the polynomials over the visits
  Eigen::MatrixXd basis_, root_;  // centred polynomials = basis_ (orthonormal) · root_ (upper)
};

}  // namespace mdof::algo
