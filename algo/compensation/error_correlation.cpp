#include "algo/compensation/error_correlation.h"

#include <cmath>

#include "algo/compensation/declared_uncertainty.h"
#include "algo/model/restate.h"
#include "algo/uncertainty/point_sensitivity.h"

namespace mdof::algo {
namespace {

constexpr std::size_t at(std::size_t k, std::size_t l) {
  return k * kErrorCount + l;
}

// Coefficients of a covariance; 0 beside a variance of 0.
Covariance5 coefficients(const Covariance5& covariance) {
  Covariance5 all{};
  for (std::size_t k = 0; k < kErrorCount; ++k)
    for (std::size_t l = 0; l < kErrorCount; ++l) {
      const double both = covariance[at(k, k)] * covariance[at(l, l)];
      all[at(k, l)] = k == l ? 1 : both > 0 ? covariance[at(k, l)] / std::sqrt(both) : 0;
    }
  return all;
}

// Of noise that all probes have alike, in a point without references.
Result<Covariance5> of_noise(const Rig& rig, const Run& run) {
  Model model = Model::rigid;
  model_from(run.header.provenance.model, model);
  MDOF_TRY(const Solver solver, Solver::create(rig, model));
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

// What is left of a correlation where two values refer to other shares of the means: the cosine of
// the weights of independent targets.
Covariance5 of_weights(const std::array<std::vector<std::vector<double>>, kErrorCount>& references,
                       std::size_t row) {
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

}  // namespace

Result<ErrorCorrelations> error_correlations(const CompensationTable& table,
                                             const std::vector<Rig>& rigs,
                                             const std::vector<Run>& runs,
                                             const TableOptions& options) {
  MDOF_TRY(const DeclaredCovariance declared, declared_covariance(table, rigs, runs, options));
  MDOF_TRY(const Covariance5 probes, of_noise(rigs.front(), restate(runs.front(), options.stated)));
  const auto references = references_of(table);
  ErrorCorrelations all;
  for (std::size_t row = 0; row < table.position_m.size(); ++row) {
    const Covariance5 weights = of_weights(references, row);
    Covariance5 noise{};
    Covariance5 sum = declared.forward.empty() ? Covariance5{} : declared.forward[row];
    for (std::size_t k = 0; k < kErrorCount; ++k)
      for (std::size_t l = 0; l < kErrorCount; ++l) {
        const double both = table.u_forward[k][row] * table.u_forward[l][row];
        if (!std::isfinite(both)) continue;
        noise[at(k, l)] = probes[at(k, l)] * weights[at(k, l)] * both;
        sum[at(k, l)] += noise[at(k, l)];
      }
    all.combined.push_back(coefficients(sum));
    all.noise.push_back(coefficients(noise));
  }
  return all;
}

}  // namespace mdof::algo
