// Uncertainty budgets of stored runs, made when they are asked for: what is stored stays as it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "algo/uncertainty/budget/budget.h"
#include "daemon/measure/evaluation.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "schema/iso230/parallelism.h"
#include "schema/notice/notice.h"
#include "schema/run.h"
#include "schema/separation/square_reversal.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::daemon {

// Of the points of a run as it states them, with the run's own rig.
RunUncertainty uncertainty_of(const Run& run);
// Of some of its points, the first among them, without the run's repeatability.
RunUncertainty uncertainty_of_stops(const Run& part);

// Of the figures that the run has; left out, with the reason, where they cannot be made or would
// take long: mdof budget RUN makes them however long it takes.
StatedFigures figure_budgets(const Run& run);

// Both at once, for half the price.
struct StatedRun {
  RunUncertainty points;
  StatedFigures figures;
};
StatedRun stated_run(const Run& run);

struct RunBudgetsRequest {
  std::int64_t run = 0;
  Reference reference = Reference::fixture;
  std::string figure;          // only this one, "EYX_straightness_um"; empty: all
  std::optional<double> at_m;  // of the errors ("EYX_um") at the target nearest to this position
  algo::TrialsRequest trials;
};
struct FoundBudgets {
  StatedAt stated;
  std::optional<double> at_m;  // the target that was taken
  std::vector<Budget> budgets;
  Notices notices;  // of the runs
  bool simulated = false;
};
// Errors: no such run, one without errors, a figure that it does not have.
Result<FoundBudgets> run_budgets(store::Store& store, const RunBudgetsRequest& request);

// Of EC0Y, as fit_squareness() makes it; nothing is stored.
Result<FoundBudgets> squareness_budgets(store::Store& store, const SquarenessRequest& request,
                                        const algo::TrialsRequest& trials);

// Squareness of two set-ups of the same square, which was turned over in between; nothing is
// stored. What the rigs say of its angle is not used. Errors: as of algo::square_reversal(), and
// those of each set-up.
struct FoundSquareReversal {
  SquareReversal found;
  std::vector<std::string> not_declared;  // keys of the rigs
  Notices notices;                        // of the runs
  bool simulated = false;
};
Result<FoundSquareReversal> square_reversal(store::Store& store, const SquarenessRequest& first,
                                            const SquarenessRequest& second);

struct ParallelismRequest {
  std::int64_t run_a = 0, run_b = 0;
  bool partial = false;  // take partial runs as well
};
struct FoundParallelism {
  Parallelism parallelism;
  Notices notices;  // of the runs
};
// With its budgets; nothing is stored. Errors: those of algo::parallelism() and of rigs that are
// not to be had.
Result<FoundParallelism> find_parallelism(store::Store& store, const ParallelismRequest& request);

// What `mdof parallelism --json` and the RPC say of it.
std::string parallelism_json(const FoundParallelism& found);

// What `mdof budget --json` and the RPC say of them; `decision` as of write_budgets().
std::string budgets_json(const FoundBudgets& found,
                         const std::optional<Decision>& decision = std::nullopt);

}  // namespace mdof::daemon
