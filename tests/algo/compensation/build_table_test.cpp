// Tables of runs whose errors are known: a parabola, a line, a reversal.
#include <gtest/gtest.h>

#include "algo/compensation/compensation.h"
#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr double kReversal_m = 0.4e-6, kReversal_rad = 3e-6, kScatter_m = 20e-9;

// Targets 0, 10 … 40 mm, with two visits in each direction.
// EYX = 1 µm + 5e-5 x + 4e-3/m x² ± reversal
// ECX = 1e-3 x ± reversal
// EZX = +20 nm in the first visits, -20 nm in the second visits
Run run_by_hand(std::int64_t id, double away_m = 0) {
  Run run;
  run.header.id = id;
  run.header.state = RunState::complete;
  run.header.stated = kAtCarriage;
  run.header.provenance.model = "rigid";
  run.header.provenance.recording_sha256 = std::to_string(id);
  std::int64_t time_ns = id * 3'600'000'000'000;
  for (int repeat = 1; repeat <= 2; ++repeat)
    for (const int direction : {1, -1})
      for (int i = 0; i < 5; ++i) {
        const int target = direction > 0 ? i + 1 : 5 - i;
        const double x = 10e-3 * (target - 1);
        MeasuredPoint& p = run.points.emplace_back();
        p.target = target;
        p.run = repeat;
        p.target_m = p.point.position_m = x + away_m;
        p.point.direction = direction;
        p.point.samples = 100;
        p.point.begin_ns = p.point.end_ns = time_ns += 1'000'000'000;
        p.errors.valid = true;
        p.errors.local[kDy] = 1e-6 + 5e-5 * x + 4e-3 * x * x + direction * kReversal_m;
        p.errors.local[kDz] = (repeat == 1 ? 1 : -1) * kScatter_m;
        p.errors.local[kEz] = 1e-3 * x + direction * kReversal_rad;
      }
  return run;
}

CompensationTable built(const std::vector<Run>& runs, bool remove_slope) {
  TableOptions options;
  options.remove_slope = remove_slope;
  options.stated = kAtCarriage;
  const auto table = build_table(runs, options);
  EXPECT_TRUE(table) << table.error().message;
  return table.value_or(CompensationTable{});
}

std::string refusal(const std::vector<Run>& runs) {
  const auto table = build_table(runs, {});
  return table ? "" : table.error().message;
}

// If the targets have equal distances, a parabola c x² minus its least-squares line is c ((x -
// middle)² - mean of (x - middle)²).
TEST(BuildTable, RefersStraightnessToLineAndAnglesToStart) {
  const auto about_line = built({run_by_hand(1)}, true), kept = built({run_by_hand(1)}, false);
  ASSERT_EQ(about_line.position_m.size(), 5U);
  for (std::size_t i = 0; i < 5; ++i) {
    const double x = 10e-3 * static_cast<double>(i), off = x - 20e-3;
    EXPECT_NEAR(about_line.position_m[i], x, 1e-15);
    EXPECT_NEAR(about_line.forward[0][i], 4e-3 * (off * off - 2e-4) + kReversal_m, 1e-15);
    EXPECT_NEAR(about_line.reverse[0][i], 4e-3 * (off * off - 2e-4) - kReversal_m, 1e-15);
    const double measured = 1e-6 + 5e-5 * x + 4e-3 * x * x;
    EXPECT_NEAR(kept.forward[0][i], measured + kReversal_m, 1e-15);
    EXPECT_NEAR(kept.reverse[0][i], measured - kReversal_m, 1e-15);
    for (const auto* table : {&about_line, &kept}) {
      EXPECT_NEAR(table->forward[4][i], 1e-3 * x + kReversal_rad, 1e-14);
      EXPECT_NEAR(table->reverse[4][i], 1e-3 * x - kReversal_rad, 1e-14);
    }
    // The two visits differ by 40 nm, equally at all targets, so u of a value as measured is 20 nm.
    // Relative to the line, u is 0, because the line moves with the values.
    for (const auto* u : {&kept.u_forward, &kept.u_reverse})
      EXPECT_NEAR((*u)[1][i], kScatter_m, 1e-14);
    for (const auto* u : {&about_line.u_forward, &about_line.u_reverse})
      EXPECT_NEAR((*u)[1][i], 0, 1e-14);
  }
  EXPECT_TRUE(about_line.slope_removed);
  EXPECT_FALSE(kept.slope_removed);
}

TEST(BuildTable, TakesRunNumbersAndSimulatedFlagFromTheRuns) {
  for (const bool simulated : {false, true}) {
    std::vector<mdof::Run> runs = {run_by_hand(7), run_by_hand(9)};
    for (mdof::Run& run : runs) run.header.simulated = simulated;
    const auto table = built(runs, true);
    EXPECT_EQ(table.simulated, simulated);
    EXPECT_EQ(table.runs, (std::vector<std::int64_t>{7, 9}));
  }
}

// Targets of two runs are the same target if their distance is at most 2 % of the step, 0.2 mm.
TEST(BuildTable, MergesTargetsWithinTheWindow) {
  EXPECT_EQ(refusal({run_by_hand(1), run_by_hand(2, 0.19e-3)}), "");
  EXPECT_NE(refusal({run_by_hand(1), run_by_hand(2, 0.21e-3)})
                .find("run 2 has a measured point at 0.21 mm"),
            std::string::npos);
}

TEST(BuildTable, RefusesIncompatibleRuns) {
  EXPECT_NE(refusal({}).find("at least one run"), std::string::npos);
  mdof::Run other = run_by_hand(2);
  other.header.axis = Axis::y;
  EXPECT_NE(refusal({run_by_hand(1), other}).find("run 2 measures axis Y"), std::string::npos);
  other = run_by_hand(2);
  other.header.sides.fixture_moves = true;
  EXPECT_NE(refusal({run_by_hand(1), other}).find("differ in the key \"moves\" or \"travel\""),
            std::string::npos);
  mdof::Run few = run_by_hand(1);
  std::erase_if(few.points, [](const MeasuredPoint& p) { return p.target > 2; });
  EXPECT_NE(refusal({few}).find("2 targets with calculated errors"), std::string::npos);
}

TEST(BuildTable, StatesTheReferencePointAndTheRuns) {
  const auto table = built({run_by_hand(1), run_by_hand(2)}, true);
  EXPECT_EQ(table.stated, kAtCarriage);
  EXPECT_TRUE(table.slope_removed);
  EXPECT_FALSE(built({run_by_hand(1)}, false).slope_removed);
  EXPECT_EQ(table.runs, (std::vector<std::int64_t>{1, 2}));
  TableOptions options;
  options.stated = kAtFixture;
  EXPECT_EQ(build_table({run_by_hand(1)}, options)->stated, kAtFixture);
}

// Three numbers of targets at one position are no table.
TEST(BuildTable, RefusesTargetsAtOnePosition) {
  mdof::Run run = run_by_hand(1);
  std::erase_if(run.points, [](const MeasuredPoint& p) { return p.target > 3; });
  EXPECT_EQ(refusal({run}), "");
  for (MeasuredPoint& p : run.points) p.target_m = p.point.position_m = 20e-3;
  const std::string said = refusal({run});
  EXPECT_NE(said.find("run 1 has 3 targets with calculated errors, but a compensation table needs"),
            std::string::npos)
      << said;
}

}  // namespace
}  // namespace mdof::algo
