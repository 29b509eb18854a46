#include "algo/uncertainty/run_uncertainty.h"

#include <algorithm>
#include <cmath>

#include "algo/drift/run_drift.h"
#include "algo/uncertainty/coverage.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

// 99.9 % point of χ² with one degree of freedom.
constexpr double kDriftChiSquareLimit = 10.83;

ErrorsUncertainty not_known() {
  Errors5 nothing;
  nothing.fill(kNaN);
  return {nothing, nothing, nothing, nothing, nothing};
}

}  // namespace

PointUncertainties::PointUncertainties(const Run& run)
    : run_(run), sums_(run.points.size()), visits_(run.points) {
  std::vector<Errors5> named(run.points.size());
  std::vector<double> time_s;
  for (std::size_t j = 0; j < sums_.size(); ++j) {
    const AxisErrors& errors = run.points[j].errors;
    const Covariance5 covariance = named_from_local(run.header.axis, errors.covariance);
    for (std::size_t k = 0; k < kErrorCount; ++k) sums_[j].noise[k] = covariance[6 * k];
    named[j] = named_from_local(run.header.moving(), errors.local);
    time_s.push_back(middle_time_s(run.points[j]));
  }
  seen_ = visits_.of(named);
  steady_ = visits_.without_trend(named, time_s);
  repeatability_.fill(visits_.has_repeats());
  if (visits_.has_repeats()) covered_ = VisitsCovered::repeated;
  if (sums_.size() > kRepeatabilityPointLimit) leave_out_repeatability();
}

void PointUncertainties::leave_out_repeatability() {
  repeatability_.fill(false);
  covered_ = VisitsCovered::left_out;
}

// All parts of a contributor have common degrees of freedom. Therefore their squares are added
// before fourth_over_freedom() is called.
void PointUncertainties::add(const Contributor& contributor,
                             const std::vector<PointShifts>& parts) {
  std::vector<Errors5> variance(sums_.size());  // local frame: the named errors have another order
                                                // and other signs
  for (const PointShifts& shifts : parts)
    for (std::size_t j = 0; j < sums_.size(); ++j)
      for (std::size_t e = 0; e < kErrorCount; ++e) variance[j][e] += shifts[j][e] * shifts[j][e];
  const auto& names = error_names(run_.header.axis);
  for (std::size_t j = 0; j < sums_.size(); ++j)
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      const double square = variance[j][names[k].local];
      sums_[j].square[k] += square;
      sums_[j].fourth_by_freedom[k] += fourth_over_freedom(square, contributor.declared.freedom);
      if (contributor.name.kind == ContributorKind::removed_drift && square > 0)
        repeatability_[k] = false;
    }
  if (contributor.key != "u_um_per_h") return;
  for (const PointShifts& shifts : parts) {
    const Errors5 between_visits = visits_.of(shifts).variance;
    for (std::size_t k = 0; k < kErrorCount; ++k) explained_[k] += between_visits[names[k].local];
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
    const auto scans = static_cast<double>(run_.points[j].point.samples);
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      double random = sums.noise[k], fourth = fourth_over_freedom(random, std::max(1.0, scans - 1));
      const double by_time = seen_.variance[k] - steady_.variance[k];
      const bool is_declared = explained_[k] > 0 && by_time <= kDriftChiSquareLimit * explained_[k];
      const VisitScatter::Pooled& scatter = is_declared ? steady_ : seen_;
      const double repeatability =
          is_declared ? steady_.variance[k] : seen_.variance[k] - explained_[k];
      if (repeatability_[k] && repeatability > random) {
        random = repeatability;
        fourth = fourth_over_freedom(scatter.variance[k], scatter.freedom[k]);
      }
      const double square = random + sums.square[k];
      out.u[k] = std::sqrt(square);
      out.u_random[k] = std::sqrt(random);
      out.freedom[k] = effective_freedom(square, fourth + sums.fourth_by_freedom[k]);
      out.coverage_factor[k] = coverage_factor(out.freedom[k]);
      out.U[k] = out.coverage_factor[k] * out.u[k];
    }
  }
  return points;
}

namespace {

RunUncertainty uncertainty(const Rig& rig, const Run& run, bool is_whole) {
  RunUncertainty out;
  out.not_declared = rig.undeclared_uncertainties();
  PointUncertainties points(run);
  if (!is_whole) points.leave_out_repeatability();
  out.declares = rig.declares_uncertainty();
  if (!run.points.empty()) {
    const auto declared = contributors(rig, run);
    if (!declared) out.why = declared.error().message;
    if (declared)
      for (const Contributor& contributor : *declared) points.add(contributor, contributor.parts());
  }
  out.points = points.stated();
  out.visits = points.visits();
  set_zeros_to_unknown(out);
  out.noise_only = is_noise_only(out);
  return out;
}

}  // namespace

void set_zeros_to_unknown(RunUncertainty& uncertainty) {
  if (uncertainty.not_declared.empty() && uncertainty.why.empty()) return;
  for (ErrorsUncertainty& point : uncertainty.points)
    for (std::size_t k = 0; k < kErrorCount; ++k)
      if (point.u[k] == 0) point.u[k] = point.U[k] = kNaN;
}

RunUncertainty run_uncertainty(const Rig& rig, const Run& run) {
  return uncertainty(rig, run, true);
}

RunUncertainty stop_uncertainty(const Rig& rig, const Run& part) {
  return uncertainty(rig, part, false);
}

}  // namespace mdof::algo
