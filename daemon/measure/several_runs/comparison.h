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
  not_shown,  // the change is within its U
  changed,    // the size did not change by more than its U, but the errors at the targets did
  unknown,    // U of the change is unknown
};
const char* to_string(Effect effect);  // "reduced", "increased", "not shown", "changed", "unknown"

struct ComparedFigure {
  Budget before, after;
  // value: |after| - |before|; a reduction is negative whatever the sign of a slope. The two runs
  // are assumed to be independent. Effects that they share (gain of a probe, mounting) cancel in
  // the change, so that u is too large rather than too small. If the sign of the figure changed,
  // shared effects add, and u is the sum of both u.
  Budget change;
  // From change_at_targets(). A value above the sum of both U is not explained by noise.
  double at_targets = kNaN;
  Effect effect = Effect::not_shown;
};

struct ComparisonRequest {
  std::int64_t before = 0, after = 0;  // runs
  Reference reference = Reference::fixture;
};
struct Comparison {
  std::int64_t before = 0, after = 0;
  Axis axis = Axis::x;
  StatedAt stated;
  std::vector<ComparedFigure> figures;  // figures that both runs have
  Notices differences;                  // differences between the two runs besides the action
  Notices notices;                      // notices of the runs
  bool simulated = false;
  bool is_imported = false;  // positioning: `stated` has no meaning
  ComparedPoints points;
  std::string no_points_reason;  // empty if `points` exist
};
// Compares two runs of the five probes, or two imported runs of positioning. Errors: those of
// run_budgets(); the same run twice; runs of two axes; an imported and a measured run; an imported
// run of another error than positioning; no common figure.
Result<Comparison> compare_runs(store::Store& store, const ComparisonRequest& request);

// The contributions that u of the changes includes.
Covers covers(const Comparison& comparison);

// The document of `mdof compare --json` and the RPC.
std::string comparison_json(const Comparison& comparison);

}  // namespace mdof::daemon
