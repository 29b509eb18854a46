// Compares the figures of an axis before and after an action on it, such as a compensation.
#pragma once

#include <cstdint>
#include <vector>

#include "daemon/measure/budgets.h"
#include "daemon/measure/several_runs/compared_points.h"
#include "schema/sample.h"

namespace mdof::daemon {

enum class Effect {
  reduced,
  increased,
  not_shown,  // the change of the figure is not larger than U of the change
  changed,    // as not_shown, but the errors at the targets have changed by more than their U
  unknown,    // U of the change is unknown
};
const char* to_string(Effect effect);  // "reduced", "increased", "not shown", "changed", "unknown"

struct ComparedFigure {
  Budget before, after;
  // Change of the absolute value: |after| - |before|. A reduction is negative, also for a negative
  // slope. u assumes that the two runs are independent. Effects that the two runs share (gain of a
  // probe, mounting) cancel in the change; u is then too large. If the figure changes its sign,
  // shared effects add up; u is then the sum u_before + u_after.
  Budget change;
  // Result of change_at_targets(). If this change is larger than U_before + U_after, noise does not
  // explain the change.
  double at_targets = kNaN;
  Effect effect = Effect::not_shown;
};

struct ComparisonRequest {
  std::int64_t before = 0, after = 0;  // numbers of the two runs
  Reference reference = Reference::fixture;
};
struct Comparison {
  std::int64_t before = 0, after = 0;
  Axis axis = Axis::x;
  StatedAt stated;
  std::vector<ComparedFigure> figures;  // figures that have a value in both runs
  Notices differences;                  // differences between the two runs besides the action
  Notices notices;                      // notices of the runs
  bool simulated = false;
  bool is_imported = false;  // true: runs of positioning; `stated` then has no meaning
  ComparedPoints points;
  std::string no_points_reason;  // empty if `points` exist
};
// Compares two measured runs, or two imported runs of positioning. Errors:
//   - those of run_budgets();
//   - the two runs are the same run, or have different axes;
//   - one run is imported and the other run is measured;
//   - an imported run contains another error than positioning;
//   - no figure has a value in both runs.
Result<Comparison> compare_runs(store::Store& store, const ComparisonRequest& request);

// The contributions that the standard uncertainty of the changes includes.
Covers covers(const Comparison& comparison);

// The document of `mdof compare --json` and of the RPC method.
std::string comparison_json(const Comparison& comparison);

}  // namespace mdof::daemon
