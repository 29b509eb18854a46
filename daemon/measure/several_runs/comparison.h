// The figures of an axis before and after something was done to it, as a compensation: what it did.
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
  changed,    // that of the size is, but not that at the targets
  unknown,    // its U is not known
};
const char* to_string(Effect effect);  // "reduced", "increased", "not shown", "changed", "unknown"

struct ComparedFigure {
  Budget before, after;
  // value: |after| - |before|, so that a reduction is negative whatever the sign of a slope is. The
  // two runs are taken as independent: what they share (a probe's gain, the mounting) cancels, so
  // that u is too large rather than too small. Where the sign has changed it adds, and u is the
  // sum.
  Budget change;
  // change_at_targets(); more than both U together is more than noise makes of it by chance.
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
  std::vector<ComparedFigure> figures;  // those that both have
  Notices differences;                  // of the two runs, beside what was done
  Notices notices;                      // of the runs
  bool simulated = false;
  bool is_imported = false;  // positioning: `stated` is of no rig
  ComparedPoints points;
  std::string why_no_points;  // empty: they are there
};
// Two runs of the five probes, or two imported ones of positioning. Errors: those of run_budgets();
// one run twice; runs of two axes; one imported and one not, or another error than positioning; no
// figure that both have.
Result<Comparison> compare_runs(store::Store& store, const ComparisonRequest& request);

// What u of its changes covers.
Covers covers(const Comparison& comparison);

// What `mdof compare --json` and the RPC say of it.
std::string comparison_json(const Comparison& comparison);

}  // namespace mdof::daemon
