#include "algo/drift/series_drift.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

constexpr double kMostCorrelation = 0.9;
constexpr double kLeastNoise2 = 1e-24;  // (1 pm)²: of readings without any noise

// Of neighbours in time; below 0 it would make a variance smaller, and is taken for 0.
double correlation_of_neighbours(const std::vector<TimedVisit>& visits,
                                 const Eigen::VectorXd& residual) {
  std::vector<std::size_t> in_time(visits.size());
  std::iota(in_time.begin(), in_time.end(), std::size_t{0});
  std::stable_sort(in_time.begin(), in_time.end(), [&](std::size_t a, std::size_t b) {
    return visits[a].time_s < visits[b].time_s;
  });
  double both = 0, square = 0;
  for (std::size_t i = 0; i < in_time.size(); ++i) {
    const double now = residual(static_cast<Eigen::Index>(in_time[i]));
    square += now * now;
    if (i > 0) both += now * residual(static_cast<Eigen::Index>(in_time[i - 1]));
  }
  return square > 0 ? std::clamp(both / square, 0.0, kMostCorrelation) : 0.0;
}

// Covariance of one reading of each series by what the fit leaves.
Eigen::MatrixXd noise_of(const DriftDesign& design, const Eigen::MatrixXd& residuals,
                         const Eigen::VectorXd& noise2) {
  Eigen::MatrixXd noise = residuals.transpose() * residuals / design.freedom();
  Eigen::VectorXd larger(noise.rows());
  for (Eigen::Index k = 0; k < noise.rows(); ++k) {
    const double r = correlation_of_neighbours(design.visits(), residuals.col(k));
    const double wanted = std::max({noise(k, k) * (1 + r) / (1 - r), noise2(k), kLeastNoise2});
    larger(k) = noise(k, k) > kLeastNoise2 ? std::sqrt(wanted / noise(k, k)) : 0;
    if (larger(k) == 0) noise(k, k) = wanted;
  }
  for (Eigen::Index a = 0; a < noise.rows(); ++a)
    for (Eigen::Index b = 0; b < noise.rows(); ++b)
      if (a != b || larger(a) > 0) noise(a, b) *= larger(a) * larger(b);
  return noise;
}

}  // namespace

double critical_t(double probability, double freedom) {
  double low = 0, high = 1e6;
  while (high - low > 1e-9 * high) {
    const double middle = (low + high) / 2;
    (t_upper_tail(middle, freedom) > probability / 2 ? low : high) = middle;
  }
  return high;
}

DriftFit::DriftFit(DriftDesign design, const Eigen::MatrixXd& y, const Eigen::VectorXd& noise2)
    : design_(std::move(design)), series_(static_cast<std::size_t>(y.cols())) {
  if (design_.orders() == 0) return;
  scores_ = design_.scores(y);
  noise_ = noise_of(design_, design_.residuals(y), noise2);
  const double tests = design_.orders() * static_cast<double>(y.cols());
  const double t = critical_t(kDriftLevel / tests, design_.freedom());
  for (Eigen::Index k = 0; k < y.cols(); ++k) series_[static_cast<std::size_t>(k)] = tested(k, t);
}

SeriesDrift DriftFit::tested(Eigen::Index k, double critical_t) const {
  const double sd = std::sqrt(noise_(k, k));
  const auto earlier = [](const TimedVisit& a, const TimedVisit& b) { return a.time_s < b.time_s; };
  const auto& visits = design_.visits();
  const auto [first, last] = std::minmax_element(visits.begin(), visits.end(), earlier);
  const Eigen::VectorXd whole = design_.shapes(last->time_s) - design_.shapes(first->time_s);
  SeriesDrift out;
  out.least_found = critical_t * sd * std::abs(whole(0));
  out.order = design_.orders();
  while (out.order > 0 && std::abs(scores_(out.order - 1, k)) <= critical_t * sd) --out.order;
  if (out.order == 0) return out;
  const auto drift = [&](const Eigen::VectorXd& shapes) {
    return shapes.head(out.order).dot(scores_.col(k).head(out.order));
  };
  out.change = drift(whole);
  out.u_change = sd * whole.head(out.order).norm();
  double low = 0, high = 0;
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const double here = drift(design_.shapes(visits[i].time_s));
    low = i == 0 ? here : std::min(low, here);
    high = i == 0 ? here : std::max(high, here);
  }
  out.range = high - low;
  return out;
}

int DriftFit::removed_order(Eigen::Index k) const {
  const SeriesDrift& of = series_[static_cast<std::size_t>(k)];
  return of.steps ? 0 : of.order;
}

Eigen::VectorXd DriftFit::drift(double time_s) const {
  const auto n = static_cast<Eigen::Index>(series_.size());
  Eigen::VectorXd out = Eigen::VectorXd::Zero(n);
  if (design_.orders() == 0) return out;
  const Eigen::VectorXd shapes = design_.shapes(time_s);
  for (Eigen::Index k = 0; k < n; ++k) {
    const int order = removed_order(k);
    out(k) = shapes.head(order).dot(scores_.col(k).head(order));
  }
  return out;
}

Eigen::MatrixXd DriftFit::covariance(double time_s) const {
  const auto n = static_cast<Eigen::Index>(series_.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(n, n);
  if (design_.orders() == 0) return out;
  const Eigen::VectorXd shapes = design_.shapes(time_s);
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < n; ++b)
      out(a, b) =
          noise_(a, b) * shapes.head(std::min(removed_order(a), removed_order(b))).squaredNorm();
  return out;
}

}  // namespace mdof::algo
