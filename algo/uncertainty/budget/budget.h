// Uncertainty budgets of the figures of a run. Each figure is calculated again from the mean errors
// with the shift of each contributor added and subtracted. So effects that are common to all points
// are separated from the others without a formula for each figure.
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
  std::uint64_t trials = 0;  // 0: no trials
  std::uint64_t seed = 1;
};

// Ratio of the variance by the scatter of runs to that by their visits. Three runs exceed it by
// chance in one of five logs.
inline constexpr double kRunsScatterMore = 1.6;

class RunBudgets {
 public:
  // Budgets of the run, of its errors as it states them. Error: as contributors().
  static Result<RunBudgets> create(const Rig& rig, const Run& run);
  // Noise and repeatability alone; add() adds contributors of that run.
  RunBudgets(const Rig& rig, const Run& run);
  void add(const Contributor& contributor, const std::vector<PointShifts>& parts);

  const MeanErrors& means() const { return means_; }
  // Targets times independent parts of contributors: the time to calculate a figure grows with it.
  std::size_t cost() const;
  // First order (GUM 5). The line of noise and repeatability is the effect of the visits' scatter
  // on the figure. It includes the correlation in time that the residuals of the visits show
  // (correlated_noise.h), and the shift that all targets of a pass share (repeatability.h). If the
  // scatter of the runs gives the figure a variance s²/n that is more than kRunsScatterMore times
  // this effect, its excess over the effect is added. U is k u, but for a range that of
  // range_interval.h. If all deviations of a range are equal, first order gives only rounding, and
  // u is the root mean square of the trials. A figure that is NaN has a budget of NaN.
  Budget of(const Figure& figure) const;
  // Budgets of all figures; the trials are drawn once for all of them.
  std::vector<Budget> of(const std::vector<Figure>& figures) const;
  // Changes of the figure by each independent part of each contributor, with their signs.
  struct Contribution {
    const Contributor* contributor = nullptr;
    std::vector<double> parts;
  };
  std::vector<Contribution> contributions(const Figure& figure) const;
  // The line of a contributor. `parts`: the contributions of its parts.
  static BudgetLine line(const Contributor& contributor, const std::vector<double>& parts);
  // The same as of(), but without trials: U is k u for a range too.
  Budget first_order(const Figure& figure) const;
  // Values of each figure in many trials (JCGM 101). Each trial draws all contributors from their
  // distributions and the random part from Student's t; for a range it draws the random part at
  // each target. Different streams are independent. The values of a figure do not depend on the
  // other figures.
  std::vector<std::vector<double>> draw(const std::vector<Figure>& figures,
                                        const TrialsRequest& request,
                                        std::uint32_t stream = 0) const;
  // Summary of these trials. For a range the interval is value ± U, by these trials.
  BudgetTrials trials(const Figure& figure, const TrialsRequest& request) const;

 private:
  struct Random {
    double u = 0, freedom = 0;
    UncertaintyPart independent;  // if the noise of the visits were independent
    double widened = 1;           // factor of the noise of each target that gives this u
  };
  struct Drawn {
    std::vector<double> values;   // values of the figure
    std::vector<double> changes;  // changes of its deviations, trial after trial; only for a range
  };
  using MeanShifts = std::vector<double>;  // named errors, five for each target
  struct Shifted {
    Contributor contributor;  // its `parts` are null
    std::vector<MeanShifts> parts;
  };
  MeanErrors moved(std::span<const double> shifts, double factor) const;
  std::vector<double> moved_by(BlockOfDraws& draws, std::size_t trials,
                               const std::vector<UnitQuantity>& quantities) const;
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
  std::vector<MeanErrors> runs_;  // means of each run of the sequence
  std::vector<Shifted> shifted_;
  std::vector<std::string> not_declared_;
};

// Needs at least two trials.
BudgetTrials summary_of(std::vector<double> trials, std::uint64_t seed);

// Calculates u, shares, degrees of freedom, k and U from the lines of a budget, and sorts the lines
// by share, largest first. If all contributions are 0, u is 0 if all uncertainties are declared,
// otherwise NaN (unknown).
void complete(Budget& budget);

}  // namespace mdof::algo
