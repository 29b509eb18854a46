#include "algo/sensitivity/distribution.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "algo/sensitivity/plan/functions.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

using Kind = Distribution::Kind;

constexpr double kNodesPerScore = 256;
constexpr double kLastScore = 8.5;  // larger than the score of any uniform number with 52 bits

// The quantile of t that has the same upper tail probability as the normal score. Newton's method
// is applied to the logarithm of the tail probability, because this logarithm is nearly linear.
// `start` must be near the quantile.
double t_node(double score, double dof, double start) {
  const double tail = normal_cdf(-score);
  double x = start;
  for (int i = 0; i < 50; ++i) {
    const double here = t_upper_tail(x, dof);
    const double step = here * natural_log(here / tail) / t_density(x, dof);
    x = std::max(x + step, x / 2);
    if (std::abs(step) <= 1e-14 * x) break;
  }
  return x;
}

}  // namespace

// Table of t quantiles x for normal scores >= 0, with the slopes φ(score) / f(x). φ is the normal
// density, f the density of t. For negative scores the quantile is negative.
struct QuantileFunction::StudentTable {
  std::vector<double> x, slope;  // slope: change of x from node to node

  explicit StudentTable(double dof) {
    const double h = 1 / kNodesPerScore;
    const auto nodes = static_cast<std::size_t>(kLastScore * kNodesPerScore) + 1;
    x.push_back(0);
    slope.push_back(h * normal_density(0) / t_density(0, dof));
    for (std::size_t i = 1; i < nodes; ++i) {
      const double score = static_cast<double>(i) * h;
      x.push_back(t_node(score, dof, x.back() + slope.back()));
      slope.push_back(h * normal_density(score) / t_density(x.back(), dof));
    }
  }

  double at(double score) const {  // score >= 0
    const double place = std::min(score, kLastScore) * kNodesPerScore;
    const auto i = std::min(static_cast<std::size_t>(place), x.size() - 2);
    const double t = place - static_cast<double>(i), s = 1 - t;
    return s * s * ((1 + 2 * t) * x[i] + t * slope[i]) +
           t * t * ((1 + 2 * s) * x[i + 1] - s * slope[i + 1]);
  }
};

QuantileFunction::QuantileFunction(const Distribution& distribution) : d_(distribution) {
  assert(d_.kind != Kind::empirical || d_.sample.size() >= 2);
  if (d_.kind == Kind::t) table_ = std::make_shared<const StudentTable>(d_.dof);
}

double QuantileFunction::at(double p) const {
  const double width = d_.high - d_.low;
  switch (d_.kind) {
    case Kind::rectangular:
      return d_.low + width * p;
    case Kind::triangular: {
      const double rise = d_.mode - d_.low, fall = d_.high - d_.mode;
      return p * width < rise ? d_.low + std::sqrt(p * width * rise)
                              : d_.high - std::sqrt((1 - p) * width * fall);
    }
    case Kind::trapezoidal:
      return trapezoidal(p);
    case Kind::u_shaped:  // -cos(πp) = sin(2π (p - 1/2)/2)
      return (d_.low + d_.high) / 2 + width / 2 * sine_of_turns((p - 0.5) / 2);
    case Kind::normal:
    case Kind::t:
      return at_score(gaussian(p));
    case Kind::empirical:
      return empirical(p);
    case Kind::constant:
      break;
  }
  return d_.centre;
}

double QuantileFunction::at_score(double score) const {
  constexpr double kLeast = 0x1p-53;
  switch (d_.kind) {
    case Kind::normal:
      return d_.centre + d_.spread * score;
    case Kind::t:
      return t_at_score(score);
    default:
      return at(std::clamp(normal_cdf(score), kLeast, 1 - kLeast));
  }
}

double QuantileFunction::t_at_score(double score) const {
  const double x = table_->at(std::abs(score));
  return d_.centre + d_.spread * (score < 0 ? -x : x);
}

// JCGM 101 §6.4.4. The width of each ramp is (1 - β)/2 times the total width.
double QuantileFunction::trapezoidal(double p) const {
  const double width = d_.high - d_.low, ramp = width * (1 - d_.beta) / 2;
  const double height = 2 / (width * (1 + d_.beta));
  const double share = height * ramp / 2;  // probability of each ramp
  if (p < share) return d_.low + std::sqrt(2 * p * ramp / height);
  if (1 - p < share) return d_.high - std::sqrt(2 * (1 - p) * ramp / height);
  return d_.low + ramp + (p - share) / height;
}

double QuantileFunction::empirical(double p) const {
  const auto n = static_cast<double>(d_.sample.size());
  const double place = std::clamp(p * n - 0.5, 0.0, n - 1);
  const auto i = std::min(static_cast<std::size_t>(place), d_.sample.size() - 2);
  const double t = place - static_cast<double>(i);
  return d_.sample[i] * (1 - t) + d_.sample[i + 1] * t;
}

double QuantileFunction::size() const {
  switch (d_.kind) {
    case Kind::constant:
      return std::abs(d_.centre);
    case Kind::normal:
    case Kind::t:
      return d_.spread;
    case Kind::empirical:
      return std::max(std::abs(d_.sample.front()), std::abs(d_.sample.back()));
    default:
      return std::max(std::abs(d_.low), std::abs(d_.high));
  }
}

}  // namespace mdof::algo
