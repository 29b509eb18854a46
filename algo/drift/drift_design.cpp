#include "algo/drift/drift_design.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <numeric>
#include <utility>

#include "algo/linear_algebra/spectra.h"

namespace mdof::algo {
namespace {

// Each combination of the first `n` polynomials has a variance between the visits of the same place
// and a variance over all visits. Returns the smallest ratio of these variances.
double least_share(const Eigen::MatrixXd& between, const Eigen::MatrixXd& all, Eigen::Index n) {
  const Eigen::MatrixXd seen = between.leftCols(n).transpose() * between.leftCols(n);
  const Eigen::MatrixXd whole = all.leftCols(n).transpose() * all.leftCols(n);
  const Eigen::LLT<Eigen::MatrixXd> root(whole);
  if (root.info() != Eigen::Success) return 0;  // fewer times than polynomials
  const Eigen::MatrixXd half = root.matrixL().solve(seen);
  const Eigen::MatrixXd share = root.matrixL().solve(half.transpose());
  return symmetric_eigenvalues(share)(0);
}

}  // namespace

DriftDesign::DriftDesign(std::vector<TimedVisit> visits) : visits_(std::move(visits)) {
  if (visits_.empty()) return;
  const auto earlier = [](const TimedVisit& a, const TimedVisit& b) { return a.time_s < b.time_s; };
  const auto [first, last] = std::minmax_element(visits_.begin(), visits_.end(), earlier);
  begin_s_ = first->time_s;
  length_s_ = last->time_s - first->time_s;
  for (const TimedVisit& v : visits_) {
    if (v.place >= visits_of_place_.size()) visits_of_place_.resize(v.place + 1);
    visits_of_place_[v.place] += 1;
  }
  if (!(length_s_ > 0)) return;
  const auto n = static_cast<Eigen::Index>(visits_.size());
  Eigen::MatrixXd all(n, kMostOrders);
  for (Eigen::Index i = 0; i < n; ++i)
    all.row(i) = legendre(visits_[static_cast<std::size_t>(i)].time_s, kMostOrders).transpose();
  const Eigen::RowVectorXd mean = all.colwise().mean();
  all.rowwise() -= mean;
  const Eigen::MatrixXd between = centred(all);
  const auto left = [&](int orders) { return visits_minus_places() - orders; };
  while (orders_ < kMostOrders && left(orders_ + 1) >= kFewestFreedom &&
         least_share(between, all, orders_ + 1) >= kFewestSeen)
    ++orders_;
  if (orders_ > 0) freedom_ = left(orders_);
}

double DriftDesign::visits_minus_places() const {
  return static_cast<double>(visits_.size()) - static_cast<double>(visits_of_place_.size());
}

Eigen::VectorXd DriftDesign::legendre(double time_s, int orders) const {
  const double x = std::clamp(2 * (time_s - begin_s_) / length_s_ - 1, -1.0, 1.0);
  Eigen::VectorXd p(orders);
  double before = 1, now = x;
  for (int k = 1; k <= orders; ++k) {
    p(k - 1) = now;
    before = std::exchange(now, ((2 * k + 1) * x * now - k * before) / (k + 1));
  }
  return p;
}

Eigen::MatrixXd DriftDesign::centred(const Eigen::MatrixXd& y) const {
  Eigen::MatrixXd means =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(visits_of_place_.size()), y.cols());
  const auto place = [&](Eigen::Index i) { return visits_[static_cast<std::size_t>(i)].place; };
  for (Eigen::Index i = 0; i < y.rows(); ++i)
    means.row(static_cast<Eigen::Index>(place(i))) += y.row(i) / visits_of_place_[place(i)];
  Eigen::MatrixXd out = y;
  for (Eigen::Index i = 0; i < y.rows(); ++i)
    out.row(i) -= means.row(static_cast<Eigen::Index>(place(i)));
  return out;
}

DriftRows DriftDesign::rows(const Eigen::MatrixXd& y) const {
  std::vector<std::size_t> in_time(visits_.size());
  std::iota(in_time.begin(), in_time.end(), std::size_t{0});
  std::stable_sort(in_time.begin(), in_time.end(), [&](std::size_t a, std::size_t b) {
    return visits_[a].time_s < visits_[b].time_s;
  });
  const auto n = static_cast<Eigen::Index>(visits_.size());
  Eigen::MatrixXd all(n, orders_ + y.cols());
  for (Eigen::Index i = 0; i < n; ++i)
    all.row(i).head(orders_) = polynomials(visits_[static_cast<std::size_t>(i)].time_s).transpose();
  all.rightCols(y.cols()) = y;
  all = centred(all);
  const std::size_t each = (visits_of_place_.size() + kMostPlaces - 1) / kMostPlaces;
  DriftRows rows;
  rows.places = (visits_of_place_.size() + each - 1) / each;
  Eigen::MatrixXd means(n, all.cols());
  std::vector<double> counts;
  for (const std::size_t i : in_time) {
    const std::size_t place = visits_[i].place / each;
    if (each == 1 || rows.place.empty() || rows.place.back() != place) {
      means.row(static_cast<Eigen::Index>(rows.place.size())).setZero();
      rows.place.push_back(place);
      rows.time_s.push_back(0);
      counts.push_back(0);
    }
    counts.back() += 1;
    rows.time_s.back() += (visits_[i].time_s - rows.time_s.back()) / counts.back();
    const auto row = static_cast<Eigen::Index>(rows.place.size()) - 1;
    means.row(row) += (all.row(static_cast<Eigen::Index>(i)) - means.row(row)) / counts.back();
  }
  const auto of = static_cast<Eigen::Index>(rows.place.size());
  rows.polynomials = means.topLeftCorner(of, orders_);
  rows.y = means.topRightCorner(of, y.cols());
  return rows;
}

double DriftRows::freedom() const {
  return static_cast<double>(polynomials.rows() - polynomials.cols()) - static_cast<double>(places);
}

Eigen::VectorXd DriftDesign::polynomials(double time_s) const {
  return legendre(time_s, orders_) - legendre(begin_s_, orders_);
}

}  // namespace mdof::algo
