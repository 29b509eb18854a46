#include "algo/uncertainty/effects/flatness.h"

#include <cmath>
#include <numbers>

#include "algo/sensitivity/plan/draws.h"
#include "algo/uncertainty/statistics/independent_parts.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kSeriesBelow = 16;  // at this x the errors of both formulas are below 3e-11
constexpr int kSeriesTerms = 40, kAsymptoticTerms = 12;

// DLMF 10.2.2
double by_series(double x) {
  const double q = x * x / 4;
  double term = 1, sum = 0;
  for (int k = 1; k <= kSeriesTerms; ++k) {
    term *= -q / (static_cast<double>(k) * k);
    sum -= term;
  }
  return sum;
}

// DLMF 10.17.3
double by_asymptotic_expansion(double x) {
  double term = 1, even = 1, odd = 0;
  for (int k = 1; k <= kAsymptoticTerms; ++k) {
    const double m = 2 * k - 1;
    term *= -m * m / (8.0 * k * x);
    const double sign = (k / 2) % 2 == 0 ? 1 : -1;
    (k % 2 == 0 ? even : odd) += sign * term;
  }
  const double turns = x / (2 * std::numbers::pi) - 0.125;
  const double cosine = sine_of_turns(turns + 0.25), sine = sine_of_turns(turns);
  return 1 - std::sqrt(2 / (std::numbers::pi * x)) * (even * cosine - odd * sine);
}

double distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return (a - b).norm();
}

}  // namespace

double one_minus_bessel_j0(double x) {
  return x < kSeriesBelow ? by_series(x) : by_asymptotic_expansion(x);
}

double FlatnessCovariance::semivariogram_m2(double apart_m) const {
  double sum = 0, norm = 0;
  for (std::size_t k = 1; k <= kFlatnessWaves; ++k) {
    const auto wave = static_cast<double>(k);
    const double weight = 1 / (wave * wave * wave * wave);
    norm += weight;
    sum += weight * one_minus_bessel_j0(2 * std::numbers::pi * wave * apart_m / length_m_);
  }
  return variance_m2_ * sum / norm;
}

double FlatnessCovariance::zeroed_m2(const Footprint& a, const Footprint& b) const {
  return semivariogram_m2(distance(a.place, b.zero)) + semivariogram_m2(distance(a.zero, b.place)) -
         semivariogram_m2(distance(a.place, b.place)) - semivariogram_m2(distance(a.zero, b.zero));
}

Eigen::MatrixXd independent_heights(const FlatnessCovariance& covariance,
                                    const std::vector<Footprint>& footprints) {
  return independent_parts(
      footprints.size(),
      [&](std::size_t i, std::size_t j) {
        return covariance.zeroed_m2(footprints[i], footprints[j]);
      },
      kMostFlatnessParts);
}

std::vector<std::vector<std::vector<Errors5>>> flatness_parts(
    const std::vector<const PlaneFootprints*>& runs) {
  std::vector<std::vector<std::vector<Errors5>>> parts(runs.size());
  if (runs.empty()) return parts;
  std::vector<Footprint> all;
  for (const PlaneFootprints* run : runs)
    all.insert(all.end(), run->footprints.begin(), run->footprints.end());
  const Eigen::MatrixXd heights =
      independent_heights({runs.front()->u_m, runs.front()->length_m}, all);
  std::size_t first = 0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    parts[r].assign(static_cast<std::size_t>(heights.cols()),
                    std::vector<Errors5>(runs[r]->points));
    for (std::size_t p = 0; p < parts[r].size(); ++p)
      for (const auto& [point, footprint, by_height] : runs[r]->readings) {
        const double height_m =
            heights(static_cast<Eigen::Index>(first + footprint), static_cast<Eigen::Index>(p));
        for (std::size_t e = 0; e < kErrorCount; ++e)
          parts[r][p][point][e] += by_height[e] * height_m;
      }
    first += runs[r]->footprints.size();
  }
  return parts;
}

}  // namespace mdof::algo
