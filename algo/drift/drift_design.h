// Which part of a drift repeated visits of the same places show: y = error of the place +
// drift(time) + noise.
//
// A place is a target with its approach. Its error is the same at each visit, and so is its
// reversal. A drift is a polynomial in time (Legendre). The part of it that is the same at every
// visit of a place cannot be distinguished from the form or the slope of the axis and is not seen.
// The order of the polynomial is limited so that at least kFewestSeen of the variance of each
// combination of its terms is seen.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mdof::algo {

struct TimedVisit {
  std::size_t place = 0;
  double time_s = 0;
};

// Data for the estimation of slow noise, in order of time. If there are many places, neighbouring
// places visited one after the other share a row with their mean, because the calculation time
// grows with places².
struct DriftRows {
  std::vector<double> time_s;
  std::vector<std::size_t> place;
  std::size_t places = 0;
  Eigen::MatrixXd polynomials, y;  // minus the means of their places

  double freedom() const;  // degrees of freedom of the residuals of the highest order
};

class DriftDesign {
 public:
  static constexpr double kFewestSeen = 0.02;
  static constexpr int kMostOrders = 6, kFewestFreedom = 4;
  static constexpr std::size_t kMostPlaces = 48;  // in DriftRows

  explicit DriftDesign(std::vector<TimedVisit> visits);

  int orders() const { return orders_; }  // 0: no drift can be separated from the form of the axis
  // Degrees of freedom of the residuals of the highest order, all visits.
  double freedom() const { return freedom_; }
  const std::vector<TimedVisit>& visits() const { return visits_; }
  double begin_s() const { return begin_s_; }            // time of the first visit
  double end_s() const { return begin_s_ + length_s_; }  // time of the last visit

  DriftRows rows(const Eigen::MatrixXd& y) const;  // `y`: visits × series; requires orders() > 0
  // The value of each order, 0 at the first visit, where the system was zeroed. Before the first
  // visit it is the value of the first visit, after the last visit the value of the last.
  Eigen::VectorXd polynomials(double time_s) const;

 private:
  Eigen::VectorXd legendre(double time_s, int orders) const;
  Eigen::MatrixXd centred(const Eigen::MatrixXd& y) const;

  std::vector<TimedVisit> visits_;
  std::vector<double> visits_of_place_;
  double begin_s_ = 0, length_s_ = 0, freedom_ = 0;
  int orders_ = 0;
};

}  // namespace mdof::algo
