#include "algo/uncertainty/statistics/run_shifts.h"

#include <Eigen/Core>
#include <array>

#include "algo/linear_algebra/least_squares.h"
#include "algo/sequence/run_drifts.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/uncertainty/statistics/independent_parts.h"

namespace mdof::algo {
namespace {

// Of one target and approach: visits by the number of the run.
using VisitsOfRuns = std::map<Eigen::Index, double>;

TargetAndWay target_and_way(const MeasuredPoint& p) {
  return {p.target, p.point.direction > 0 ? 1 : 0};
}

double number_of_visits(const VisitsOfRuns& visits) {
  double sum = 0;
  for (const auto& [run, n] : visits) sum += n;
  return sum;
}

}  // namespace

// The mean of a target and approach without the shifts s of its runs r is ȳ - Σ (n_r/n) s_r. By
// least squares s depends on what the visits differ by from ȳ, and so is independent of it; its
// covariance is the inverse of the normal equations without the means.
std::vector<std::map<TargetAndWay, double>> parts_by_run_shifts(
    const std::vector<MeasuredPoint>& counted) {
  if (!any_run_lacks_visits(counted)) return {};
  std::map<int, Eigen::Index> runs;
  for (const MeasuredPoint& p : counted)
    runs.emplace(p.run, static_cast<Eigen::Index>(runs.size()));
  if (runs.size() > kMostShiftedRuns) return {};
  std::map<TargetAndWay, VisitsOfRuns> visits;
  for (const MeasuredPoint& p : counted) visits[target_and_way(p)][runs.at(p.run)] += 1;
  const auto n = static_cast<Eigen::Index>(runs.size());
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(n, n);
  for (const auto& [at, of_runs] : visits)
    for (const auto& [run, here] : of_runs) {
      normal(run, run) += here;
      for (const auto& [other, there] : of_runs)
        normal(run, other) -= here * there / number_of_visits(of_runs);
    }
  const Eigen::MatrixXd covariance = LeastNorm(normal).inverse();
  const Eigen::MatrixXd shifts = independent_parts(
      runs.size(),
      [&](std::size_t i, std::size_t j) {
        return covariance(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      },
      runs.size());
  std::vector<std::map<TargetAndWay, double>> parts(static_cast<std::size_t>(shifts.cols()));
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const auto& [at, of_runs] : visits)
      for (const auto& [run, here] : of_runs)
        parts[p][at] -=
            here / number_of_visits(of_runs) * shifts(run, static_cast<Eigen::Index>(p));
  return parts;
}

std::map<TargetAndWay, Errors5> left_by_passes(const std::vector<MeasuredPoint>& counted) {
  std::map<TargetAndWay, Errors5> left;
  if (!any_run_lacks_visits(counted)) return left;
  std::vector<MeasuredPoint> passes = counted;
  std::vector<Errors5> errors;
  std::map<TargetAndWay, double> visits;
  for (MeasuredPoint& p : passes) {
    p.run = 2 * p.run + target_and_way(p).second;
    errors.push_back(p.errors.local);
    visits[target_and_way(p)] += 1;
  }
  const RunDrifts runs(counted), of_passes(passes);
  const std::vector<Errors5> of_run = runs.of(errors), of_pass = of_passes.of(errors);
  // What all passes of one way have in common passes for the reversal: it is not of the shifts.
  std::array<Errors5, 2> sum{};
  std::array<double, 2> n{};
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const auto way = static_cast<std::size_t>(target_and_way(counted[i]).second);
    n[way] += 1;
    for (std::size_t k = 0; k < kErrorCount; ++k) {
      errors[i][k] = of_pass[of_passes.run_of_points()[i]][k] - of_run[runs.run_of_points()[i]][k];
      sum[way][k] += errors[i][k];
    }
  }
  for (std::size_t i = 0; i < counted.size(); ++i) {
    const TargetAndWay at = target_and_way(counted[i]);
    const auto way = static_cast<std::size_t>(at.second);
    for (std::size_t k = 0; k < kErrorCount; ++k)
      left[at][k] += (errors[i][k] - sum[way][k] / n[way]) / visits.at(at);
  }
  return left;
}

}  // namespace mdof::algo
