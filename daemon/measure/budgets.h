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

// Uncertainty of the points of a run at its stated point, with the run's own rig.
RunUncertainty uncertainty_of(const Run& run);
// Uncertainty of some points of a run. `part` must contain the first point. Repeatability of the
// run is not included.
RunUncertainty stop_uncertainty(const Run& part);

// Budgets of the figures of the run. The result is empty and gives the reason if the budgets cannot
// be calculated or would take long; `mdof budget RUN` calculates them in any case.
StatedFigures figure_budgets(const Run& run);

// Both of the above, calculated together at half the cost.
struct StatedRun {
  RunUncertainty points;
  StatedFigures figures;
};
StatedRun stated_run(const Run& run);

struct RunBudgetsRequest {
  std::int64_t run = 0;
  Reference reference = Reference::fixture;
  std::string figure;          // the only wanted figure, "EYX_straightness_um"; empty: all figures
  std::optional<double> at_m;  // errors ("EYX_um") at the target nearest to this position
  algo::TrialsRequest trials;
};
struct FoundBudgets {
  StatedAt stated;
  std::optional<double> at_m;  // position of the target that was used
  std::vector<Budget> budgets;
  Notices notices;  // notices of the runs
  bool simulated = false;
};
// Errors: unknown run; run without error values; figure that the run does not have.
Result<FoundBudgets> run_budgets(store::Store& store, const RunBudgetsRequest& request);

// Budget of EC0Y as fit_squareness() calculates it. Nothing is stored.
Result<FoundBudgets> squareness_budgets(store::Store& store, const SquarenessRequest& request,
                                        const algo::TrialsRequest& trials);

// Squareness from two set-ups of the same square, which was turned over between them. Nothing is
// stored. The angle of the square in the rigs is not used. Errors: those of algo::square_reversal()
// and those of each set-up.
struct FoundSquareReversal {
  SquareReversal found;
  std::vector<std::string> not_declared;  // keys of the rigs
  Notices notices;                        // notices of the runs
  bool simulated = false;
};
Result<FoundSquareReversal> square_reversal(store::Store& store, const SquarenessRequest& first,
                                            const SquarenessRequest& second);

struct ParallelismRequest {
  std::int64_t run_a = 0, run_b = 0;
  bool partial = false;  // also use partial runs
};
struct FoundParallelism {
  Parallelism parallelism;
  Notices notices;  // notices of the runs
};
// Parallelism with its budgets. Nothing is stored. Errors: those of algo::parallelism(), and rigs
// that cannot be read.
Result<FoundParallelism> find_parallelism(store::Store& store, const ParallelismRequest& request);

// The document of `mdof parallelism --json` and the RPC.
std::string parallelism_json(const FoundParallelism& found);

// The document of `mdof budget --json` and the RPC; `decision` as in write_budgets().
std::string budgets_json(const FoundBudgets& found,
                         const std::optional<Decision>& decision = std::nullopt);

}  // namespace mdof::daemon
