#include "tools/mdof/text/analyses/drift_text.h"

#include <gtest/gtest.h>

namespace mdof::tools {
namespace {

// A run of 3 min with two changes: δy drifts by +0.25 µm; δz changes by +0.5 µm, which may be
// steps.
algo::RunDrift drift_and_steps() {
  algo::RunDrift drift;
  drift.length_s = 180;
  const auto set = [&](std::size_t local, double change_m, bool steps) {
    algo::SeriesDrift& of = drift.errors[local];
    of.order = 1;
    of.change = of.range = change_m;
    of.u_change = 4e-9;
    of.steps = steps;
  };
  set(kDy, 0.25e-6, false);
  set(kDz, 0.5e-6, true);
  return drift;
}

TEST(DriftText, StatesTheRemedyForADrift) {
  mdof::Run run;
  run.header.axis = Axis::x;
  EXPECT_EQ(
      drift_notice(run, drift_and_steps(), 1000),
      "drift: EYX +0.2500 ± 0.0040 µm from the first point to the last (3 min). All "
      "errors of a single approach, and all errors relative to the first point, contain this "
      "drift. "
      "Let the system warm up (\"mdof drift\" shows when the system is ready), or replay the log "
      "with --remove-drift\n"
      "changes from run to run: EZX +0.5000 ± 0.0040 µm from the first point to the last "
      "(3 min). These changes may be steps or a drift, so --remove-drift does not remove them\n");
  EXPECT_EQ(drift_notice(run, algo::RunDrift{}, 1000), "");
}

}  // namespace
}  // namespace mdof::tools
