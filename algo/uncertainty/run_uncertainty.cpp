#include "algo/uncertainty/run_uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/coverage.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

// Of one point: the sum of u_i², and that of u_i⁴/ν_i (GUM G.2b), of the named errors.
struct Sums {
  Errors5 noise{}, square{}, fourth_by_freedom{};
  void add(const Errors5& variance, double freedom) {
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      square[k] += variance[k];
      fourth_by_freedom[k] += variance[k] * variance[k] / freedom;
    }
  }
};

Sums noise_of(Axis axis, const MeasuredPoint& p) {
  const Covariance5 named = named_from_local(axis, p.errors.covariance);
  Sums sums;
  for (std::size_t k = 0; k < kErrorCount; ++k) sums.noise[k] = named[6 * k];
  sums.add(sums.noise, std::max(1.0, static_cast<double>(p.point.samples) - 1));
  return sums;
}

// The parts of one contributor are one contributor: their squares are added first.
void add(const Contributor& contributor, Axis axis, std::vector<Sums>& points) {
  std::vector<Errors5> variance(points.size());
  for (const PointShifts& shifts : contributor.parts())
    for (std::size_t j = 0; j < points.size(); ++j) {
      const Errors5 named = named_from_local(axis, shifts[j]);
      for (std::size_t k = 0; k < kErrorCount; ++k) variance[j][k] += named[k] * named[k];
    }
  for (std::size_t j = 0; j < points.size(); ++j)
    points[j].add(variance[j], contributor.declared.freedom);
}

ErrorsUncertainty of_sums(const Sums& sums) {
  ErrorsUncertainty out;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    out.u[k] = std::sqrt(sums.square[k]);
    out.u_random[k] = std::sqrt(sums.noise[k]);
    out.freedom[k] = sums.fourth_by_freedom[k] > 0
                         ? sums.square[k] * sums.square[k] / sums.fourth_by_freedom[k]
                         : std::numeric_limits<double>::infinity();
    out.coverage_factor[k] = coverage_factor(out.freedom[k]);
    out.U[k] = out.coverage_factor[k] * out.u[k];
  }
  return out;
}

ErrorsUncertainty not_known() {
  Errors5 nothing;
  nothing.fill(kNaN);
  return {nothing, nothing, nothing, nothing, nothing};
}

}  // namespace

RunUncertainty run_uncertainty(const Rig& rig, const Run& run) {
  RunUncertainty out;
  out.not_declared = rig.undeclared_uncertainties();
  const Axis axis = run.header.axis;
  std::vector<Sums> sums;
  for (const MeasuredPoint& p : run.points) sums.push_back(noise_of(axis, p));
  if (rig.declares_uncertainty() && !run.points.empty()) {
    const auto declared = contributors(rig, run);
    if (!declared) out.why = declared.error().message;
    out.noise_only = !declared;
    if (declared)
      for (const Contributor& contributor : *declared) add(contributor, axis, sums);
  }
  for (std::size_t j = 0; j < sums.size(); ++j)
    out.points.push_back(run.points[j].errors.valid ? of_sums(sums[j]) : not_known());
  return out;
}

}  // namespace mdof::algo
