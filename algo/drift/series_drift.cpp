#include "algo/drift/series_drift.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/sensitivity/plan/functions.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kLeastNoise2 = 1e-24;                // (1 pm)², for readings without noise
constexpr double kNearlyAsLikely = 7, kAsLikely = 2;  // differences of -2 log(likelihood)
// Limit of a score, in sd of the score: a subtracted drift has smaller scores, due to rounding.
constexpr double kLeastScore = 1e-6;
constexpr Eigen::Index kWaves = 12;  // waves of the slow noise: 1 to 12 half periods in the log
constexpr double kPi = 3.14159265358979323846;

// Lower triangular L with L Lᵀ = S; values that rounding makes negative are set to 0.
Eigen::MatrixXd root_of(const Eigen::MatrixXd& S) {
  Eigen::MatrixXd root = Eigen::MatrixXd::Zero(S.rows(), S.rows());
  for (Eigen::Index a = 0; a < S.rows(); ++a)
    for (Eigen::Index b = 0; b <= a; ++b) {
      const double left = S(a, b) - root.row(a).head(b).dot(root.row(b).head(b));
      if (a == b)
        root(a, a) = std::sqrt(std::max(left, 0.0));
      else if (root(b, b) > 0)
        root(a, b) = left / root(b, b);
    }
  return root;
}

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
  correlation_ =
      root_of(size.asDiagonal().inverse() * fits.front().left * size.asDiagonal().inverse());
  const double tests = design_.orders() * static_cast<double>(y.cols());
  const double t = critical_t(kDriftLevel / tests, freedom_);
  for (Eigen::Index k = 0; k < y.cols(); ++k) estimate(k, fits, noise2(k), t);
}

void DriftFit::estimate(Eigen::Index k, const std::vector<WeighedFit>& fits, double noise2,
                        double critical_t) {
  std::vector<double> unlikely;
  for (const WeighedFit& fit : fits)
    unlikely.push_back(fit.minus_two_log_likelihood(k, freedom_, kLeastNoise2));
  const auto likeliest = std::min_element(unlikely.begin(), unlikely.end());
  const auto sd_of = [&](const WeighedFit& fit) {
    return std::sqrt(std::max({fit.left(k, k) / freedom_, noise2, kLeastNoise2}));
  };
  const Eigen::VectorXd whole = design_.polynomials(design_.end_s());
  int order = design_.orders();
  double least_found = 0, largest_u = 0;
  const WeighedFit* taken = nullptr;
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (unlikely[i] > *likeliest + kNearlyAsLikely) continue;
    const double sd = sd_of(fits[i]), least = critical_t * sd;
    const Eigen::VectorXd shapes = fits[i].shapes(whole);
    order = std::min(order, highest_significant(fits[i], k, least));
    least_found = std::max(least_found, least * std::abs(shapes(0)));
    if (unlikely[i] > *likeliest + kAsLikely || sd * shapes.norm() <= largest_u) continue;
    largest_u = sd * shapes.norm();
    taken = &fits[i];
  }
  estimates_.push_back({taken->scores.col(k), taken->root, sd_of(*taken), taken->noise, {}, {}});
  series_[static_cast<std::size_t>(k)] = described(estimates_.back(), order);
  series_[static_cast<std::size_t>(k)].least_found = least_found;
  const WeighedFit& best = fits[static_cast<std::size_t>(likeliest - unlikely.begin())];
  if (order > 0)
    series_[static_cast<std::size_t>(k)].u_change = sd_of(best) * best.shapes(whole).norm();
}

// Approximates the slow noise by kWaves cosines; cosine m has m half periods over the log. The
// cosines are nearly independent, and their spectrum at the angular frequency ω is 2 τ/(1 + ω²τ²).
// Calculates the effect of the cosines on the scores. The rest of the variance of the scores is due
// to white noise.
void DriftFit::split_noise(Estimate& of) const {
  const auto n = static_cast<Eigen::Index>(design_.visits().size());
  Eigen::MatrixXd y(n, kWaves);
  for (Eigen::Index i = 0; i < n; ++i)
    y.row(i) = waves(of, design_.visits()[static_cast<std::size_t>(i)].time_s).transpose();
  of.of_waves = weighed_fit(design_.rows(y), of.noise).scores;
  of.of_white = root_of(of.sd * of.sd * Eigen::MatrixXd::Identity(of.root.rows(), of.root.rows()) -
                        of.of_waves * of.of_waves.transpose());
}

Eigen::VectorXd DriftFit::waves(const Estimate& of, double time_s) const {
  const double length_s = design_.end_s() - design_.begin_s();
  const double part = std::clamp((time_s - design_.begin_s()) / length_s, 0.0, 1.0);
  Eigen::VectorXd waves = Eigen::VectorXd::Zero(kWaves);
  for (Eigen::Index m = 1; m <= kWaves && of.noise.share > 0; ++m) {
    const double turn = kPi * static_cast<double>(m) * of.noise.correlation_s / length_s;
    const double variance =
        2 * of.noise.share * of.noise.correlation_s / length_s / (1 + turn * turn);
    const double cosine = sine_of_turns(0.25 + static_cast<double>(m) * part / 2);
    waves(m - 1) = of.sd * std::sqrt(2 * variance) * (cosine - 1);
  }
  return waves;
}

Eigen::VectorXd DriftFit::shapes(const Estimate& of, double time_s) const {
  return of.root.transpose().triangularView<Eigen::Lower>().solve(design_.polynomials(time_s));
}

SeriesDrift DriftFit::described(const Estimate& of, int order) const {
  SeriesDrift out;
  out.order = order;
  if (order == 0) return out;
  out.change = shapes(of, design_.end_s()).dot(of.scores);
  double low = 0, high = 0;  // at the first visit
  for (const TimedVisit& visit : design_.visits()) {
    const double here = shapes(of, visit.time_s).dot(of.scores);
    low = std::min(low, here);
    high = std::max(high, here);
  }
  out.range = high - low;
  return out;
}

Eigen::VectorXd DriftFit::drift(double time_s) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(series_.size()));
  for (std::size_t k = 0; k < estimates_.size(); ++k)
    if (series_[k].significant() && !series_[k].steps)
      out(static_cast<Eigen::Index>(k)) = shapes(estimates_[k], time_s).dot(estimates_[k].scores);
  return out;
}

bool DriftFit::taken(std::size_t series) const {
  const Estimate& of = estimates_[series];
  return (of.scores.array().abs() < kLeastScore * of.sd).all();
}

std::vector<Eigen::MatrixXd> DriftFit::parts(const std::vector<double>& time_s) {
  const auto n = static_cast<Eigen::Index>(series_.size()), each = design_.orders() + kWaves;
  std::vector<Eigen::MatrixXd> parts(time_s.size(), Eigen::MatrixXd::Zero(n, n * each));
  for (std::size_t a = 0; a < estimates_.size(); ++a) {
    if (!taken(a)) continue;
    Estimate& of = estimates_[a];
    split_noise(of);
    const auto row = static_cast<Eigen::Index>(a);
    for (std::size_t j = 0; j < time_s.size(); ++j) {
      const Eigen::VectorXd here = shapes(of, time_s[j]);
      Eigen::VectorXd by(each);
      by.head(design_.orders()) = of.of_white.transpose() * here;
      by.tail(kWaves) = waves(of, time_s[j]) - of.of_waves.transpose() * here;
      for (Eigen::Index i = 0; i < each; ++i)
        parts[j].row(row).segment(i * n, n) = by(i) * correlation_.row(row);
    }
  }
  return parts;
}

}  // namespace mdof::algo
