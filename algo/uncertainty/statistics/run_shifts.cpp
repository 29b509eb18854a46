#include "algo/uncertainty/statistics/run_shifts.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "algo/linear_algebra/least_squares.h"
#include "algo/sequence/run_drifts.h"
#include "algo/sequence/uneven_visits.h"
#include "algo/uncertainty/statistics/independent_parts.h"

namespace mdof::algo {
namespace {

// Number of visits of one target and approach, by the index of the run.
using VisitsOfRuns = std::map<Eigen::Index, double>;

TargetAndApproach target_and_approach(const MeasuredPoint& p) {
  return {p.target, p.point.direction > 0 ? 1 : 0};
}

double number_of_visits(const VisitsOfRuns& visits) {
  double sum = 0;
  for (const auto& [run, n] : visits) sum += n;
  return sum;
}

}  // namespace

// ȳ is the mean of the n visits of a target and approach; n_r of these visits are in run r, which
// has the shift s_r. Without the shifts, the mean is ȳ - Σ (n_r/n) s_r. The least-squares estimates
// of the shifts depend only on the differences of the visits from ȳ. Therefore they are independent
// of ȳ. Their covariance is the inverse of the normal matrix from which the means of the targets
// are eliminated.
std::vector<std::map<TargetAndApproach, double>> parts_by_run_shifts(
    const std::vector<MeasuredPoint>& counted) {
  if (!any_run_lacks_visits(counted)) return {};
  std::map<int, Eigen::Index> runs;
  for (const MeasuredPoint& p : counted)
    runs.emplace(p.run, static_cast<Eigen::Index>(runs.size()));
  if (runs.size() > kMostShiftedRuns) return {};
  std::map<TargetAndApproach, VisitsOfRuns> visits;
  for (const MeasuredPoint& p : counted) visits[target_and_approach(p)][runs.at(p.run)] += 1;
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
  std::vector<std::map<TargetAndApproach, double>> parts(static_cast<std::size_t>(shifts.cols()));
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const auto& [at, of_runs] : visits)
      for (const auto& [run, here] : of_runs)
        parts[p][at] -=
            here / number_of_visits(of_runs) * shifts(run, static_cast<Eigen::Index>(p));
  return parts;
}

namespace {

// Half the difference between the levels of the two passes, for each run that has both passes.
struct HalfDifferences {
  std::vector<int> runs;
  std::vector<Errors5> half;  // of each run, plus a constant that is the same for all runs
  std::vector<double> visit_variance_factor;  // variance of `half` for a variance of one visit of 1
};

HalfDifferences half_differences(const MovingAxis& moving,
                                 const std::vector<MeasuredPoint>& counted) {
  std::vector<MeasuredPoint> passes = counted;
  std::vector<Errors5> errors;
  struct Pass {
    std::size_t number = 0;
    double visits = 0;
  };
  std::map<int, std::array<Pass, 2>> of_run;
  for (MeasuredPoint& p : passes) {
    p.run = 2 * p.run + target_and_approach(p).second;
    errors.push_back(named_from_local(moving, p.errors.local));
  }
  const RunDrifts fitted(passes);
  const std::vector<Errors5> level = fitted.of(errors);
  for (std::size_t i = 0; i < counted.size(); ++i) {
    Pass& pass =
        of_run[counted[i].run][static_cast<std::size_t>(target_and_approach(counted[i]).second)];
    pass.number = fitted.point_runs()[i];
    pass.visits += 1;
  }
  HalfDifferences found;
  for (const auto& [run, pass] : of_run) {
    if (pass[0].visits == 0 || pass[1].visits == 0) continue;
    found.runs.push_back(run);
    Errors5& half = found.half.emplace_back();
    for (std::size_t k = 0; k < kErrorCount; ++k)
      half[k] = (level[pass[1].number][k] - level[pass[0].number][k]) / 2;
    found.visit_variance_factor.push_back((1 / pass[0].visits + 1 / pass[1].visits) / 4);
  }
  return found;
}

// Changes of the means if the errors are 1 higher in the forward pass and 1 lower in the reverse
// pass of `run`.
std::map<TargetAndApproach, double> half_difference_effect(
    const RunDrifts& drifts, const std::vector<MeasuredPoint>& counted, int run) {
  std::vector<Errors5> changes(counted.size());
  for (std::size_t i = 0; i < counted.size(); ++i)
    if (counted[i].run == run) changes[i][0] = target_and_approach(counted[i]).second == 1 ? 1 : -1;
  const std::vector<Errors5> taken = drifts.of(changes);
  std::map<TargetAndApproach, double> sum, visits;
  for (std::size_t i = 0; i < counted.size(); ++i) {
    sum[target_and_approach(counted[i])] += changes[i][0] - taken[drifts.point_runs()[i]][0];
    visits[target_and_approach(counted[i])] += 1;
  }
  for (auto& [at, change] : sum) change /= visits.at(at);
  return sum;
}

}  // namespace

PassLevels pass_levels(const MovingAxis& moving, const std::vector<MeasuredPoint>& counted,
                       const Errors5& u_visit) {
  PassLevels found;
  if (!any_run_lacks_visits(counted)) return found;
  const HalfDifferences halves = half_differences(moving, counted);
  const auto n = static_cast<double>(halves.runs.size());
  if (halves.runs.size() < 2 || halves.runs.size() > kMostShiftedRuns) return found;
  for (std::size_t k = 0; k < kErrorCount; ++k) {
    double mean = 0, variance = 0;
    for (const Errors5& half : halves.half) mean += half[k] / n;
    for (std::size_t r = 0; r < halves.half.size(); ++r)
      variance += (halves.half[r][k] - mean) * (halves.half[r][k] - mean) / (n - 1) -
                  halves.visit_variance_factor[r] * u_visit[k] * u_visit[k] / n;
    found.u_half[k] = std::sqrt(std::max(0.0, variance));
  }
  found.freedom = n - 1;
  const RunDrifts drifts(counted);
  for (const int run : halves.runs)
    found.parts.push_back(half_difference_effect(drifts, counted, run));
  return found;
}

}  // namespace mdof::algo
