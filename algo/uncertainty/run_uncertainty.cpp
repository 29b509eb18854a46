#include "algo/uncertainty/run_uncertainty.h"

#include <algorithm>
#include <cmath>

#include "algo/uncertainty/coverage.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

ErrorsUncertainty not_known() {
  Errors5 nothing;
  nothing.fill(kNaN);
  return {nothing, nothing, nothing, nothing, nothing};
}

}  // namespace

void PointUncertainties::Sums::add(const Errors5& variance, double freedom) {
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    square[k] += variance[k];
    fourth_by_freedom[k] += fourth_by(variance[k], freedom);
  }
}

PointUncertainties::PointUncertainties(const Run& run) : run_(run), sums_(run.points.size()) {
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    const MeasuredPoint& p = run.points[j];
    const Covariance5 named = named_from_local(run.header.axis, p.errors.covariance);
    for (std::size_t k = 0; k < kErrorCount; ++k) sums_[j].noise[k] = named[6 * k];
    sums_[j].add(sums_[j].noise, std::max(1.0, static_cast<double>(p.point.samples) - 1));
  }
}

// The parts of one contributor are one contributor: their squares are added first.
void PointUncertainties::add(const Contributor& contributor,
                             const std::vector<PointShifts>& parts) {
  std::vector<Errors5> variance(sums_.size());  // local: the names differ in order and sign
  for (const PointShifts& shifts : parts)
    for (std::size_t j = 0; j < sums_.size(); ++j)
      for (std::size_t e = 0; e < kErrorCount; ++e) variance[j][e] += shifts[j][e] * shifts[j][e];
  const auto& names = error_names(run_.header.axis);
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    Errors5 named{};
    for (std::size_t k = 0; k < kErrorCount; ++k) named[k] = variance[j][names[k].local];
    sums_[j].add(named, contributor.declared.freedom);
  }
}

std::vector<ErrorsUncertainty> PointUncertainties::stated() const {
  std::vector<ErrorsUncertainty> points;
  points.reserve(sums_.size());
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    if (!run_.points[j].errors.valid) {
      points.push_back(not_known());
      continue;
    }
    const Sums& sums = sums_[j];
    ErrorsUncertainty& out = points.emplace_back();
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      out.u[k] = std::sqrt(sums.square[k]);
      out.u_random[k] = std::sqrt(sums.noise[k]);
      out.freedom[k] = effective_freedom(sums.square[k], sums.fourth_by_freedom[k]);
      out.coverage_factor[k] = coverage_factor(out.freedom[k]);
      out.U[k] = out.coverage_factor[k] * out.u[k];
    }
  }
  return points;
}

RunUncertainty run_uncertainty(const Rig& rig, const Run& run) {
  RunUncertainty out;
  out.not_declared = rig.undeclared_uncertainties();
  PointUncertainties points(run);
  out.declares = rig.declares_uncertainty();
  if (!run.points.empty()) {
    const auto declared = contributors(rig, run);
    if (!declared) out.why = declared.error().message;
    if (declared)
      for (const Contributor& contributor : *declared) points.add(contributor, contributor.parts());
  }
  out.points = points.stated();
  out.noise_only = is_noise_only(out);
  return out;
}

}  // namespace mdof::algo
