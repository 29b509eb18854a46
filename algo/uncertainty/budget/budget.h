// The uncertainty budget of the figures of a run: each figure is made again of the mean errors with
// each contributor's shift added and taken off. So what is common to all points stays apart from
// what is not, without a formula for each figure.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "algo/iso230/target_changes.h"
#include "algo/uncertainty/budget/budget_draws.h"
#include "algo/uncertainty/budget/figures.h"
#include "algo/uncertainty/contributors.h"
#include "algo/uncertainty/coverage.h"
#include "algo/uncertainty/statistics/repeatability.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::algo {

struct TrialsRequest {
  std::uint64_t trials = 0;  // 0: none
  std::uint64_t seed = 1;
};

// By chance, the scatter of runs is that much more than what their visits show in one of five logs
// of three runs.
inline constexpr double kRunsScatterMore = 1.6;

class RunBudgets {
 public:
  // Of the run as it is stated. Error: as contributors().
  static Result<RunBudgets> create(const Rig& rig, const Run& run);
  // Of noise and repeatability alone, to which contributors of that run are added.
  RunBudgets(const Rig& rig, const Run& run);
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);

  const MeanErrors& means() const { return means_; }
  // Targets times independent parts of contributors: the time of a figure grows with it.
  std::size_t cost() const;
  // First order (GUM 5). The part of noise and repeatability is what the visits' scatter does to
  // the figure, with the correlation in time that their residuals show
  // (correlated_noise.h), with the shift that all targets of a pass share (repeatability.h); and,
  // where the variance of the figure by the scatter of the runs' own, s²/n, is more than
  // kRunsScatterMore times that, what it has beyond it. U is k u; of a range it is that of
  // range_interval.h; where all deviations are equal, so that first order sees nothing but
  // rounding, u is the root mean square of the trials. A figure that is NaN has a budget of NaN.
  Budget of(const Figure& figure) const;
  // Of each; the trials are drawn once for all of them.
  std::vector<Budget> of(const std::vector<Figure>& figures) const;
  // By how much each independent part of each contributor changes the figure, with its sign.
  struct Contribution {
    const Contributor* contributor = nullptr;
    std::vector<double> parts;
  };
  std::vector<Contribution> contributions(const Figure& figure) const;
  // The line of a contributor whose parts contribute so.
  static BudgetLine line(const Contributor& contributor, const std::vector<double>& parts);
  // The same without trials: U is k u of a range too.
  Budget first_order(const Figure& figure) const;
  // JCGM 101: each figure of many trials, in each of which all contributors are drawn from their
  // distributions, and what is random from Student's t; for a range, at each target by itself. Any
  // other `stream` is independent. What a
  // figure gets does not depend on which others are asked for.
  std::vector<std::vector<double>> draw(const std::vector<Figure>& figures,
                                        const TrialsRequest& request,
                                        std::uint32_t stream = 0) const;
  // Their summary. Of a range the interval is that of its U by these trials.
  BudgetTrials trials(const Figure& figure, const TrialsRequest& request) const;

 private:
  struct Random {
    double u = 0, freedom = 0;
    UncertaintyPart
        independent;     // of it, if the noise of the visits does not follow its neighbours
    double widened = 1;  // the noise of each target, to have this u
  };
  struct Drawn {
    std::vector<double> values;   // of the figure
    std::vector<double> changes;  // of its deviations, trial after trial; of a range only
  };
  using MeanShifts = std::vector<double>;  // named, five by target
  struct Shifted {
    Contributor contributor;  // without its parts
    std::vector<MeanShifts> parts;
  };
  MeanErrors moved(std::span<const double> shifts, double factor) const;
  std::vector<double> moved_by(BlockOfDraws& draws, std::size_t trials,
                               const std::vector<OneU>& quantities) const;
  std::vector<Drawn> drawn(const std::vector<Figure>& figures, const TrialsRequest& request,
                           std::uint32_t stream) const;
  double half_difference(const Figure& figure, const MeanShifts& shifts) const;
  Random random_of_targets(const Figure& figure) const;
  std::optional<std::size_t> only_error(const Figure& figure, std::size_t i) const;
  Random random_of_runs(const Figure& figure) const;
  double by_removed_drift(const Figure& figure) const;
  Random random_of(const Figure& figure) const;

  MeanErrors means_;
  Repeatability repeatability_;
  TargetChanges changes_;
  std::vector<MeanErrors> runs_;  // of each run of the sequence alone
  std::vector<Shifted> shifted_;
  std::vector<std::string> not_declared_;
};

// Of at least two trials.
BudgetTrials summary_of(std::vector<double> trials, std::uint64_t seed);

// What follows from all lines of a budget: u, shares, the largest first, degrees of freedom, k, U.
// Where they are all 0, u is 0 only if nothing is left undeclared; else it is not known, NaN.
void complete(Budget& budget);

}  // namespace mdof::algo
