// Uncertainty budgets of the figures of a run. To find the effect of a contributor on a figure, the
// figure is calculated twice: with the shifts by the contributor added to the mean errors, and with
// the shifts subtracted from them. No figure needs a formula for its uncertainty.
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
#include "algo/uncertainty/statistics/range_interval.h"
#include "algo/uncertainty/statistics/repeatability.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"

namespace mdof::algo {

struct TrialsRequest {
  std::uint64_t trials = 0;  // 0: no trials
  std::uint64_t seed = 1;
};

// Limit for the variance of a figure by the scatter of the runs, divided by its variance by the
// scatter of the visits. Three runs exceed this limit by chance in one of five logs.
inline constexpr double kRunsScatterMore = 1.6;

class RunBudgets {
 public:
  // Budgets of the figures of the errors at the reference point of the run. Error: as
  // contributors().
  static Result<RunBudgets> create(const Rig& rig, const Run& run);
  // Budgets with noise and repeatability only. add() adds the contributors of this run.
  RunBudgets(const Rig& rig, const Run& run);
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);

  const MeanErrors& means() const { return means_; }
  // Number of targets times number of independent parts. The time to calculate a figure is about
  // proportional to this number.
  std::size_t cost() const;
  // Budget of first order (GUM 5). The contribution "noise and repeatability" is the effect of the
  // scatter of the visits on the figure. It includes the correlation in time of the residuals
  // (correlated_noise.h) and the shift that all targets of a pass have in common (repeatability.h).
  // The values of the figure in n runs, with the standard deviation s, give another variance s²/n.
  // If this variance is more than kRunsScatterMore times the variance by the visits, the difference
  // is added. U is k u; for a range, U is calculated as in range_interval.h. If this U exceeds
  // three times u and 1.5 times k u of first order, the deviations are not larger than their
  // uncertainty, and u is the root mean square of the trials about the true range R - U (0 if R - U
  // is negative). If the figure is NaN, the budget is NaN.
  Budget of(const Figure& figure) const;
  // Budgets of several figures, from the same trials.
  std::vector<Budget> of(const std::vector<Figure>& figures) const;
  // Change of the figure by each independent part of each contributor, with its sign.
  struct Contribution {
    const Contributor* contributor = nullptr;
    std::vector<double> parts;
  };
  std::vector<Contribution> contributions(const Figure& figure) const;
  // The line of one contributor in a budget. `parts`: contribution of each part.
  static BudgetLine line(const Contributor& contributor, const std::vector<double>& parts);
  // As of(), but without trials: U is k u also for a range.
  Budget first_order(const Figure& figure) const;
  // Values of each figure in many trials (JCGM 101). Each trial draws all contributors from their
  // distributions. It draws noise and repeatability from Student's t distribution: one number for
  // the figure, or for a range one number for each target. Different streams are independent. The
  // values of a figure do not depend on the other figures.
  std::vector<std::vector<double>> draw(const std::vector<Figure>& figures,
                                        const TrialsRequest& request,
                                        std::uint32_t stream = 0) const;
  // Summary of the trials of draw(). For a range the interval is value ± U, with U from these
  // trials.
  BudgetTrials trials(const Figure& figure, const TrialsRequest& request) const;

 private:
  struct Random {
    double u = 0, freedom = 0;
    UncertaintyPart independent;  // u and degrees of freedom for independent noise of the visits
    double widened = 1;           // u / independent.u: factor for the noise of each target
  };
  struct Drawn {
    std::vector<double> values;   // one value of the figure for each trial
    std::vector<double> changes;  // changes of all deviations of a range in the first trial, then
                                  // in the next trial, and so on; empty if the figure is no range
  };
  using MeanShifts = std::vector<double>;  // named errors, five for each target
  struct Shifted {
    Contributor contributor;  // contributor.parts is null
    std::vector<MeanShifts> parts;
  };
  // Sets the errors of `means`, a copy of means_, to the measured errors plus factor times shifts.
  void move(MeanErrors& means, std::span<const double> shifts, double factor) const;
  std::vector<double> moved_by(BlockOfDraws& draws, std::size_t trials,
                               const std::vector<UnitQuantity>& quantities) const;
  std::vector<Drawn> drawn(const std::vector<Figure>& figures, const TrialsRequest& request,
                           std::uint32_t stream) const;
  double half_difference(const Figure& figure, const MeanShifts& shifts) const;
  // The same for a shift of the mean errors at target i only. `means`: a copy of means_; the
  // function changes and restores it, because a new copy of all means for each target takes longer.
  static double half_difference_at(const Figure& figure, MeanErrors& means, std::size_t i,
                                   const Errors5& shift);
  Random random_of_targets(const Figure& figure) const;
  std::optional<std::size_t> only_error(const Figure& figure, std::size_t i) const;
  Random random_of_runs(const Figure& figure) const;
  double by_removed_drift(const Figure& figure) const;
  Random random_of(const Figure& figure) const;

  MeanErrors means_;
  Repeatability repeatability_;
  TargetChanges changes_;
  std::vector<MeanErrors> runs_;  // means of each run of the sequence
  std::vector<Shifted> shifted_;
  std::vector<std::string> not_declared_;
};

// Needs at least two trials.
BudgetTrials summary_of(std::vector<double> trials, std::uint64_t seed);

// Calculates u, shares, degrees of freedom, k and U from the lines of a budget. Sorts the lines by
// share, largest first. If all contributions are 0, u is 0 if all uncertainties are declared;
// otherwise u is NaN (unknown).
void complete(Budget& budget);
// Replaces U, and if necessary u, of a completed budget of a range; see RunBudgets::of().
void state_interval(Budget& budget, const RangeTrials& range);

}  // namespace mdof::algo
