#include "algo/compensation/error_covariance.h"

#include <cmath>

#include "algo/compensation/declared_uncertainty.h"
#include "algo/model/restate.h"
#include "algo/uncertainty/point_sensitivity.h"

namespace mdof::algo {
namespace {

constexpr std::size_t at(std::size_t k, std::size_t l) {
  return k * kErrorCount + l;
}

// Correlation coefficients of a covariance; 0 if a variance is 0.
Covariance5 coefficients(const Covariance5& covariance) {
  Covariance5 all{};
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (std::size_t l = 0; l < kErrorCount; ++l) {
      const double both = covariance[at(k, k)] * covariance[at(l, l)];
      all[at(k, l)] = k == l ? 1 : both > 0 ? covariance[at(k, l)] / std::sqrt(both) : 0;
    }
  return all;
}

// Returns the covariance of the five errors of a point if all probes have the same noise.
// References are not subtracted.
Result<Covariance5> of_noise(const Rig& rig, const Run& run) {
  MDOF_TRY(const Solver solver, Solver::create(rig, model_of(run)));
  Covariance5 sum{};
  for (const PointSensitivity& point : point_sensitivities(solver, run)) {
    if (!point.valid) continue;
    for (const Errors5& local : point.by_probe) {
      const Errors5 by = named_from_local(run.header.moving(), local);
      for (std::size_t k = 0; k < kErrorCount; ++k)
        for (std::size_t l = 0; l < kErrorCount; ++l) sum[at(k, l)] += by[k] * by[l];
    }
    break;
  }
  return coefficients(sum);
}

// Returns the factor by which the correlation of two errors decreases if their references have
// different weights: the cosine of the angle between the vectors of their weights.
Covariance5 weight_correlation(
    const std::array<std::vector<std::vector<double>>, kErrorCount>& references, std::size_t row) {
  Covariance5 products{};
  const std::size_t n = references[0][row].size();
  for (std::size_t j = 0; j < n; ++j) {
    Errors5 weight{};
    for (std::size_t k = 0; k < kErrorCount; ++k)
      weight[k] = (j == row ? 1.0 : 0.0) - references[k][row][j];
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l) products[at(k, l)] += weight[k] * weight[l];
  }
  return coefficients(products);
}

// Returns the larger noise of both approaches. NaN is replaced by the largest noise of the other
// positions, or by 0 if the noise of all positions is unknown.
std::array<std::vector<double>, kErrorCount> noise_of(const CompensationTable& table) {
  std::array<std::vector<double>, kErrorCount> u;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    double largest = 0;
    for (std::size_t row = 0; row < table.position_m.size(); ++row) {
      u[k].push_back(std::fmax(table.u_forward[k][row], table.u_reverse[k][row]));
      largest = std::fmax(largest, u[k].back());
    }
    for (double& each : u[k])
      if (std::isnan(each)) each = largest;
  }
  return u;
}

// Returns the covariance of the forward approach, scaled so that each variance is the larger
// variance of the two approaches. If one approach has no values, the result is the covariance of
// the other approach.
Covariance5 larger_covariance(const Covariance5& forward, const Covariance5& reverse) {
  if (forward == Covariance5{}) return reverse;
  Errors5 scale;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    const double f = forward[at(k, k)], r = reverse[at(k, k)];
    scale[k] = f > 0 && r > f ? std::sqrt(r / f) : 1;
  }
  Covariance5 both{};
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (std::size_t l = 0; l < kErrorCount; ++l)
      both[at(k, l)] = scale[k] * scale[l] * forward[at(k, l)];
  for (std::size_t k = 0; k < kErrorCount; ++k)
    both[at(k, k)] = std::fmax(both[at(k, k)], reverse[at(k, k)]);
  return both;
}

}  // namespace

Result<ErrorCovariances> error_covariances(const CompensationTable& table,
                                           const std::vector<Rig>& rigs,
                                           const std::vector<Run>& runs,
                                           const TableOptions& options) {
  MDOF_TRY(const DeclaredCovariance declared, declared_covariance(table, rigs, runs, options));
  MDOF_TRY(const Covariance5 probes, of_noise(rigs.front(), restate(runs.front(), options.stated)));
  const auto references = references_of(table, options);
  const auto u_noise = noise_of(table);
  ErrorCovariances all;
  for (std::size_t row = 0; row < table.position_m.size(); ++row) {
    const Covariance5 weights = weight_correlation(references, row);
    Covariance5& noise = all.noise.emplace_back();
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l)
        noise[at(k, l)] =
            u_noise[k][row] * u_noise[l][row] * (k == l ? 1 : probes[at(k, l)] * weights[at(k, l)]);
    if (!declared.forward.empty())
      all.declared.push_back(larger_covariance(declared.forward[row], declared.reverse[row]));
  }
  return all;
}

}  // namespace mdof::algo
