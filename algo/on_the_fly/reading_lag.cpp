#include "algo/on_the_fly/reading_lag.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <map>

#include "algo/linear_algebra/least_squares.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestTargets = 12;
constexpr double kSignificant = 5, kLeast_m = 2e-9;
// Smallest rms of the slope after subtraction of a line, as share of the rms of the slope.
constexpr double kSlopeChanges = 0.01;
constexpr double kMostCorrelated = 0.9;

// Sums over the passes in one direction, for one probe at one target; n: number of passes.
struct OneWay {
  double reading_m = 0, slope_1 = 0, speed_m_s = 0, n = 0;
};

struct BothWays {
  double position_m = 0;
  OneWay forward, reverse;
  bool whole() const { return forward.n > 0 && reverse.n > 0; }
};

// One equation of the fit.
struct Difference {
  double position_m = 0, difference_m = 0;
  double factor_m_s = 0;  // change of the difference per second of delay
};

std::vector<Difference> differences_of(const std::vector<PassBins>& passes, std::size_t probe,
                                       ReadingLag& lag) {
  std::map<std::int64_t, BothWays> targets;
  double speeds_m_s = 0, n = 0;
  for (const PassBins& pass : passes) {
    for (const BinPoint& bin : pass.bins) {
      if (!std::isfinite(bin.point.probe_m[probe])) continue;
      BothWays& at = targets[bin.place];
      at.position_m = bin.point.position_m;
      OneWay& way = pass.direction > 0 ? at.forward : at.reverse;
      way.reading_m += bin.point.probe_m[probe];
      way.slope_1 += bin.slope[probe];
      way.speed_m_s += bin.speed_m_s;
      way.n += 1;
      lag.largest_slope_1 = std::max(lag.largest_slope_1, std::abs(bin.slope[probe]));
      speeds_m_s += bin.speed_m_s;
      n += 1;
    }
  }
  lag.speed_m_s = n > 0 ? speeds_m_s / n : kNaN;
  std::vector<Difference> rows;
  for (const auto& [place, at] : targets) {
    if (!at.whole()) continue;
    const OneWay &f = at.forward, &r = at.reverse;
    const double slope_1 = 0.5 * (f.slope_1 / f.n + r.slope_1 / r.n);
    rows.push_back({at.position_m, f.reading_m / f.n - r.reading_m / r.n,
                    -slope_1 * (f.speed_m_s / f.n + r.speed_m_s / r.n)});
  }
  return rows;
}

// Returns the factor by which the standard deviation of a sum increases if neighbouring residuals
// are correlated.
double widened_by(const Eigen::VectorXd& residuals) {
  double square = 0, product = 0;
  for (Eigen::Index i = 0; i < residuals.size(); ++i) {
    square += residuals[i] * residuals[i];
    if (i > 0) product += residuals[i] * residuals[i - 1];
  }
  const double alike = square > 0 ? std::clamp(product / square, 0.0, kMostCorrelated) : 0;
  return std::sqrt((1 + alike) / (1 - alike));
}

void fit(const std::vector<Difference>& rows, ReadingLag& lag) {
  lag.delay_s = lag.u_delay_s = kNaN;
  if (rows.size() < kFewestTargets) return;
  const auto n = static_cast<Eigen::Index>(rows.size());
  Eigen::MatrixXd even(n, 2);
  Eigen::VectorXd factor(n), difference(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Difference& row = rows[static_cast<std::size_t>(i)];
    even(i, 0) = 1;
    even(i, 1) = row.position_m - rows.front().position_m;
    factor[i] = row.factor_m_s;
    difference[i] = row.difference_m;
  }
  const LeastSquares line(even);
  const Eigen::VectorXd changes = factor - even * line.solve(factor);
  const Eigen::VectorXd odd = difference - even * line.solve(difference);
  const double square = changes.squaredNorm();
  if (!(square > kSlopeChanges * kSlopeChanges * factor.squaredNorm())) return;
  lag.delay_s = changes.dot(odd) / square;
  const Eigen::VectorXd residuals = odd - lag.delay_s * changes;
  const double variance = residuals.squaredNorm() / static_cast<double>(n - 3);
  lag.u_delay_s = std::sqrt(variance / square) * widened_by(residuals);
  lag.effect_m = std::abs(lag.delay_s) * lag.speed_m_s * lag.largest_slope_1;
  lag.significant = std::abs(lag.delay_s) > kSignificant * lag.u_delay_s && lag.effect_m > kLeast_m;
}

}  // namespace

std::vector<ReadingLag> reading_lags(const std::vector<PassBins>& passes, std::size_t probes) {
  std::vector<ReadingLag> lags(probes);
  for (std::size_t k = 0; k < probes; ++k) fit(differences_of(passes, k, lags[k]), lags[k]);
  return lags;
}

}  // namespace mdof::algo
