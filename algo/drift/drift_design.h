// Determines which part of a drift can be found from repeated visits of the same places. The model
// of a reading y:
//   y = error of the place + drift(time) + noise
//
// A place is a target and a direction of approach. The error of a place is the same at each visit.
// The drift is a Legendre polynomial in time. A part of the drift that is the same at every visit
// of a place cannot be distinguished from the form or the slope of the axis. The order of the
// polynomial is limited so that, for each combination of its terms, at least the share kFewestSeen
// of the variance can be distinguished.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace mdof::algo {

struct TimedVisit {
  std::size_t place = 0;
  double time_s = 0;
};

// Visits for the estimation of slow noise, one row for each visit, in order of time. The
// calculation time grows with the square of the number of places. If there are more than
// kMostPlaces places, several neighbouring places count as one place. Their consecutive visits are
// then averaged to one row.
struct DriftRows {
  std::vector<double> time_s;
  std::vector<std::size_t> place;
  std::size_t places = 0;
  Eigen::MatrixXd polynomials, y;  // both minus the mean of the place

  double freedom() const;  // degrees of freedom of the residuals of a fit of highest order
};

class DriftDesign {
 public:
  static constexpr double kFewestSeen = 0.02;
  static constexpr int kMostOrders = 6, kFewestFreedom = 4;
  static constexpr std::size_t kMostPlaces = 48;  // limit of DriftRows::places

  explicit DriftDesign(std::vector<TimedVisit> visits);

  // Highest order; 0: no drift can be distinguished from the form of the axis.
  int orders() const { return orders_; }
  // Degrees of freedom of the residuals of all visits if the fit has the highest order.
  double freedom() const { return freedom_; }
  const std::vector<TimedVisit>& visits() const { return visits_; }
  double begin_s() const { return begin_s_; }            // time of the first visit
  double end_s() const { return begin_s_ + length_s_; }  // time of the last visit

  double visits_minus_places() const;
  // Subtracts from each row the mean of all visits of its place. `y`: visits × series
  Eigen::MatrixXd centred(const Eigen::MatrixXd& y) const;
  DriftRows rows(const Eigen::MatrixXd& y) const;  // requires orders() > 0
  // Returns the value of the polynomial of each order. The value is 0 at the first visit, because
  // the system was zeroed there. Before the first visit and after the last visit the value is held.
  Eigen::VectorXd polynomials(double time_s) const;

 private:
  Eigen::VectorXd legendre(double time_s, int orders) const;

  std::vector<TimedVisit> visits_;
  std::vector<double> visits_of_place_;
  double begin_s_ = 0, length_s_ = 0, freedom_ = 0;
  int orders_ = 0;
};

}  // namespace mdof::algo
