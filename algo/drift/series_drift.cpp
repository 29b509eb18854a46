#include "algo/drift/series_drift.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/linear_algebra/covariance_root.h"
#include "algo/sensitivity/plan/functions.h"

namespace mdof::algo {
namespace {

constexpr double kNearlyAsLikely = 7;  // difference of -2 log(likelihood)
constexpr double kLeastShare = 1e-3;   // part of the variance that few_parts() may leave out
constexpr std::size_t kTimesToChoose = 200;

int highest_significant(const WeighedFit& fit, Eigen::Index series, double least) {
  auto order = static_cast<int>(fit.scores.rows());
  while (order > 0 && std::abs(fit.scores(order - 1, series)) <= least) --order;
  return order;
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
  const DriftRows rows = design_.rows(y);
  if (rows.freedom() < DriftDesign::kFewestFreedom) return;
  freedom_ = rows.freedom();
  std::vector<WeighedFit> fits;
  for (const SlowNoise& noise : slow_noises(rows.time_s))
    if (WeighedFit fit = weighed_fit(rows, noise); fit.solved) fits.push_back(std::move(fit));
  if (fits.empty()) return;
  const Eigen::VectorXd size = fits.front().left.diagonal().cwiseMax(kLeastNoise2).cwiseSqrt();
  correlation_ = covariance_root(Eigen::MatrixXd(size.asDiagonal().inverse() * fits.front().left *
                                                 size.asDiagonal().inverse()));
  const double tests = design_.orders() * static_cast<double>(y.cols());
  const double t = critical_t(kDriftLevel / tests, freedom_);
  for (Eigen::Index k = 0; k < y.cols(); ++k)
    series_[static_cast<std::size_t>(k)] = tested(k, fits, noise2(k), t);
  const auto significant = [](const SeriesDrift& drift) { return drift.significant(); };
  if (std::none_of(series_.begin(), series_.end(), significant)) return;
  process_.emplace(design_, y, noise2);
  describe_significant();
}

SeriesDrift DriftFit::tested(Eigen::Index k, const std::vector<WeighedFit>& fits, double noise2,
                             double critical_t) const {
  std::vector<double> unlikely;
  for (const WeighedFit& fit : fits)
    unlikely.push_back(fit.minus_two_log_likelihood(k, freedom_, kLeastNoise2));
  const double least_unlikely = *std::min_element(unlikely.begin(), unlikely.end());
  const Eigen::VectorXd whole = design_.polynomials(design_.end_s());
  SeriesDrift out;
  out.order = design_.orders();
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (unlikely[i] > least_unlikely + kNearlyAsLikely) continue;
    const double sd = std::sqrt(std::max({fits[i].left(k, k) / freedom_, noise2, kLeastNoise2}));
    const double least = critical_t * sd;
    out.order = std::min(out.order, highest_significant(fits[i], k, least));
    out.least_found = std::max(out.least_found, least * std::abs(fits[i].shapes(whole)(0)));
  }
  return out;
}

void DriftFit::describe_significant() {
  const auto n = static_cast<Eigen::Index>(series_.size());
  Eigen::VectorXd low = Eigen::VectorXd::Zero(n), high = low;  // at the first visit
  for (const TimedVisit& visit : design_.visits()) {
    const Eigen::VectorXd here = process_->drift(process_->terms(visit.time_s));
    low = low.cwiseMin(here);
    high = high.cwiseMax(here);
  }
  const Eigen::VectorXd at_end = process_->terms(design_.end_s()), change = process_->drift(at_end);
  for (Eigen::Index k = 0; k < n; ++k) {
    SeriesDrift& of = series_[static_cast<std::size_t>(k)];
    if (!of.significant()) continue;
    of.change = change(k);
    of.u_change = process_->u(k, at_end);
    of.range = high(k) - low(k);
  }
}

bool DriftFit::removed(std::size_t series) const {
  return series_[series].significant() && !series_[series].steps;
}

double DriftFit::freedom() const {
  if (!process_) return 0;
  double fewest = DriftProcess::freedom_of_noise(design_);
  for (std::size_t k = 0; k < series_.size(); ++k)
    if (removed(k)) fewest = std::min(fewest, process_->freedom(static_cast<Eigen::Index>(k)));
  return fewest;
}

Eigen::VectorXd DriftFit::course(double time_s) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(series_.size()));
  if (!process_) return out;
  const Eigen::VectorXd drift = process_->drift(process_->terms(time_s));
  for (Eigen::Index k = 0; k < out.size(); ++k)
    if (series_[static_cast<std::size_t>(k)].significant()) out(k) = drift(k);
  return out;
}

Eigen::VectorXd DriftFit::drift(double time_s) const {
  Eigen::VectorXd out = course(time_s);
  for (Eigen::Index k = 0; k < out.size(); ++k)
    if (!removed(static_cast<std::size_t>(k))) out(k) = 0;
  return out;
}

std::vector<Eigen::MatrixXd> DriftFit::parts(const std::vector<double>& time_s) const {
  const auto n = static_cast<Eigen::Index>(series_.size());
  std::vector<Eigen::MatrixXd> parts(time_s.size(), Eigen::MatrixXd::Zero(n, 0));
  if (!process_) return parts;
  const Eigen::MatrixXd few = few_parts(time_s);
  std::vector<Eigen::MatrixXd> by_term;
  for (Eigen::Index k = 0; k < n; ++k) by_term.emplace_back(process_->root(k) * few);
  for (std::size_t j = 0; j < parts.size(); ++j) {
    parts[j] = Eigen::MatrixXd::Zero(n, n * few.cols());
    const Eigen::RowVectorXd terms = process_->terms(time_s[j]).transpose();
    for (Eigen::Index k = 0; k < n; ++k) {
      if (!removed(static_cast<std::size_t>(k))) continue;
      const Eigen::RowVectorXd here = terms * by_term[static_cast<std::size_t>(k)];
      for (Eigen::Index i = 0; i < few.cols(); ++i)
        parts[j].row(k).segment(i * n, n) = here(i) * correlation_.row(k);
    }
  }
  return parts;
}

// The process has many parts that are nearly the same. Returns few orthogonal combinations of these
// parts; they contain at least 1 - kLeastShare of the variance. Shape: parts × combinations.
Eigen::MatrixXd DriftFit::few_parts(const std::vector<double>& time_s) const {
  const std::size_t step = 1 + time_s.size() / kTimesToChoose;
  const Eigen::VectorXd at_end = process_->terms(design_.end_s());
  std::vector<Eigen::VectorXd> left;
  double all = 0;
  for (std::size_t series = 0; series < series_.size(); ++series) {
    const auto k = static_cast<Eigen::Index>(series);
    const double u = process_->u(k, at_end);
    for (std::size_t j = 0; j < time_s.size() && removed(series) && u > 0; j += step) {
      left.emplace_back(process_->root(k).transpose() * process_->terms(time_s[j]) / u);
      all += left.back().squaredNorm();
    }
  }
  std::vector<Eigen::VectorXd> chosen;
  const auto smaller = [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return a.squaredNorm() < b.squaredNorm();
  };
  for (double rest = all; rest > kLeastShare * all;) {
    chosen.push_back(std::max_element(left.begin(), left.end(), smaller)->normalized());
    rest = 0;
    for (Eigen::VectorXd& of : left) {
      of -= chosen.back().dot(of) * chosen.back();
      rest += of.squaredNorm();
    }
  }
  Eigen::MatrixXd few(at_end.size(), static_cast<Eigen::Index>(chosen.size()));
  for (std::size_t i = 0; i < chosen.size(); ++i) few.col(static_cast<Eigen::Index>(i)) = chosen[i];
  return few;
}

}  // namespace mdof::algo
