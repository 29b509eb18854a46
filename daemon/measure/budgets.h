// Uncertainty budgets of stored runs, calculated on request. The stored data do not change.
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

// Uncertainty of the errors at each point of a run, for the reference point of the run. The rig is
// read from the provenance of the run.
RunUncertainty uncertainty_of(const Run& run);
// Uncertainty of some points of a run. `part` must contain the first point of the run. The
// uncertainty does not include the repeatability of the run.
RunUncertainty stop_uncertainty(const Run& part);

// Error: the calculation of the budgets of all figures of a run would take more than about 1 s.
Status check_cost(const algo::RunBudgets& budgets);

// Budgets of the figures of the run. If the budgets cannot be calculated, or if the calculation
// would take long, the result contains only the reason. `mdof budget RUN` also calculates budgets
// that take long.
StatedFigures figure_budgets(const Run& run);

// The results of uncertainty_of() and figure_budgets(). One call of stated_run() takes half the
// time of the two calls.
struct StatedRun {
  RunUncertainty points;
  StatedFigures figures;
};
StatedRun stated_run(const Run& run);

struct RunBudgetsRequest {
  std::int64_t run = 0;
  Reference reference = Reference::fixture;
  // Name of the only requested figure, "EYX_straightness_um"; empty: all figures.
  std::string figure;
  // If set: budgets of the errors ("EYX_um") at the target nearest to this position.
  std::optional<double> at_m;
  algo::TrialsRequest trials;
};
struct FoundBudgets {
  StatedAt stated;
  std::optional<double> at_m;  // position of the target of these budgets
  std::vector<Budget> budgets;
  Notices notices;  // notices of the runs
  bool simulated = false;
};
// Errors: the run is unknown or has no error values; the run does not have the figure.
Result<FoundBudgets> run_budgets(store::Store& store, const RunBudgetsRequest& request);

// The budget of the squareness of two runs (EC0Y for X and Y). Nothing is stored.
Result<FoundBudgets> squareness_budgets(store::Store& store, const SquarenessRequest& request,
                                        const algo::TrialsRequest& trials);

// Squareness from two set-ups of the same square. The square is turned over between the two
// set-ups. The result does not use the angle of the square that the rigs declare, but a notice
// states a contradiction to this angle. Each axis is evaluated over the travel that both set-ups
// cover. Nothing is stored. Errors: those of algo::square_reversal(), of squareness_runs() for each
// set-up and of algo::over_common_travel() for each axis; runs with readings in common.
struct FoundSquareReversal {
  SquareReversal found;
  std::vector<std::string> not_declared;  // keys of the uncertainties that the rigs do not declare
  Notices notices;                        // of the runs, and algo::square_notices()
  bool simulated = false;
};
Result<FoundSquareReversal> square_reversal(store::Store& store, SquarenessRequest first,
                                            SquarenessRequest second);

struct ParallelismRequest {
  std::int64_t run_a = 0, run_b = 0;
  bool partial = false;  // true: also accept partial runs
};
struct FoundParallelism {
  Parallelism parallelism;
  Notices notices;  // notices of the runs
};
// Parallelism with its budgets. Nothing is stored. Errors: those of algo::parallelism(); a rig
// cannot be read.
Result<FoundParallelism> find_parallelism(store::Store& store, const ParallelismRequest& request);

// The document of `mdof parallelism --json` and of the RPC method.
std::string parallelism_json(const FoundParallelism& found);

// The document of `mdof budget --json` and of the RPC method. `decision`: as in write_budgets().
std::string budgets_json(const FoundBudgets& found,
                         const std::optional<Decision>& decision = std::nullopt);

}  // namespace mdof::daemon
