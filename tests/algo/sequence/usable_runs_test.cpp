#include "algo/sequence/usable_runs.h"

#include <gtest/gtest.h>

#include "algo/compensation/compensation.h"
#include "algo/iso230/squareness.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

mdof::Run run_of(std::int64_t id, RunState state, const std::string& recording,
                 Axis axis = Axis::x) {
  mdof::Run run;
  run.header.id = id;
  run.header.axis = axis;
  run.header.state = state;
  run.header.provenance.recording_path = "/data/log.mdofrec";
  run.header.provenance.recording_sha256 = recording;
  for (const int direction : {1, -1}) {
    for (int i = 0; i < 5; ++i) {
      MeasuredPoint p;
      p.target = i + 1;
      p.run = 1;
      p.point.direction = direction;
      p.point.position_m = p.target_m = 0.01 * i;
      p.errors.valid = true;
      p.errors.local[0] = 1e-6 * (i % 2);
      run.points.push_back(p);
    }
  }
  return run;
}

std::string refusal(const std::vector<mdof::Run>& runs, TableOptions options = {}) {
  const auto table = build_table(runs, options);
  return table ? "" : table.error().message;
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TableOptions with_partial_runs() {
  TableOptions options;
  options.take_partial = true;
  return options;
}

TEST(UsableRuns, UsesAPartialRunOnlyOnRequest) {
  const mdof::Run partial = run_of(7, RunState::partial, "a");
  const std::string why = refusal({partial});
  EXPECT_TRUE(contains(why, "run 7 is partial")) << why;
  EXPECT_EQ(check_usable({&partial}, false, "a table").error().remedy, Remedy::take_partial_runs);
  EXPECT_EQ(refusal({partial}, with_partial_runs()), "");
  const Notices notices = inherited_notices({&partial});
  ASSERT_EQ(notices.size(), 1u);
  EXPECT_EQ(test::shown(notices[0]), "made_from_partial run=7");
}

TEST(UsableRuns, NeverUsesAnAbortedOrFailedRun) {
  for (const RunState state : {RunState::aborted, RunState::failed, RunState::open}) {
    const mdof::Run run = run_of(7, state, "a");
    EXPECT_TRUE(contains(refusal({run}, with_partial_runs()), to_string(state)));
  }
  EXPECT_TRUE(inherited_notices(all_of({run_of(7, RunState::complete, "a")})).empty());
}

TEST(UsableRuns, ARunThatWasReplacedHasNotFailed) {
  mdof::Run run = run_of(7, RunState::failed, "a");
  run.header.notices = {notice(NoticeCode::superseded_by_renumbering)};
  EXPECT_TRUE(contains(refusal({run}), "run 7 was replaced by a later run")) << refusal({run});
  EXPECT_FALSE(contains(refusal({run}), "failed"));
}

// At the end of the travel a probe was saturated, which changed a squareness by 96 urad. Only the
// run had a notice.
TEST(UsableRuns, InheritsTheNoticesOfTheRuns) {
  mdof::Run a = run_of(7, RunState::complete, "a"), b = run_of(8, RunState::complete, "b");
  b.header.notices = {notice(NoticeCode::cycle_unknown), notice(NoticeCode::probe_dead, "A")};
  EXPECT_EQ(test::shown(inherited_notices({&a, &b})),
            "run 8: cycle_unknown\nrun 8: probe_dead A\n");
}

TEST(UsableRuns, RejectsSimulatedWithMeasuredRuns) {
  mdof::Run a = run_of(7, RunState::complete, "a"), b = run_of(8, RunState::complete, "b");
  b.header.simulated = true;
  EXPECT_TRUE(contains(refusal({a, b}), "run 8 is simulated and run 7 is measured"));
  a.header.simulated = true;
  EXPECT_EQ(refusal({a, b}), "");
}

// If the same readings were counted twice, u would be too small by a factor of √2.
TEST(UsableRuns, RejectsTheSameRecordingTwice) {
  const auto run = [](std::int64_t id, const char* recording) {
    return run_of(id, RunState::complete, recording);
  };
  const std::string why = refusal({run(1, "a"), run(2, "b"), run(5, "a")});
  EXPECT_TRUE(contains(why, "run 1 and run 5 come from the same recording")) << why;
  EXPECT_TRUE(contains(why, "leave one run out") && contains(why, "/data/log.mdofrec")) << why;
  EXPECT_EQ(refusal({run(1, "a"), run(2, "b")}), "");
  EXPECT_EQ(refusal({run(1, ""), run(2, "")}), "");  // the recordings are unknown and may differ
  EXPECT_TRUE(contains(refusal({run(1, ""), run(1, "")}), "run 1 is given twice"));
}

TEST(UsableRuns, RejectsARunWithItsContinuation) {
  const mdof::Run first = run_of(4, RunState::complete, "a");
  mdof::Run second = run_of(6, RunState::complete, "b");
  second.header.supersedes = 4;
  for (const auto& runs : {std::vector{first, second}, std::vector{second, first}})
    EXPECT_TRUE(contains(refusal(runs), "run 6 continues run 4")) << refusal(runs);
}

// Runs with common readings: a log and its compressed copy; a run and a continuation of its
// continuation.
TEST(UsableRuns, RejectsRunsWithCommonReadings) {
  mdof::Run log = run_of(1, RunState::complete, "a"), copy = run_of(2, RunState::complete, "b");
  for (std::size_t i = 0; i < log.points.size(); ++i)
    for (mdof::Run* run : {&log, &copy}) {
      run->points[i].point.begin_ns = static_cast<std::int64_t>(i) * 1'000'000'000;
      run->points[i].point.probe_m = {1e-6, 2e-6 * static_cast<double>(i)};
    }
  mdof::Run other = copy;
  for (auto& p : other.points) p.point.probe_m[0] += 1e-12;
  EXPECT_EQ(refusal({log, other}), "");
  other.points[6].point = log.points[6].point;
  for (const mdof::Run& run : {copy, other})
    EXPECT_TRUE(contains(refusal({log, run}), "readings in common")) << refusal({log, run});
}

TEST(UsableRuns, SquarenessHasTheSameRules) {
  const mdof::Run x = run_of(1, RunState::complete, "a"),
                  y = run_of(2, RunState::partial, "b", Axis::y);
  EXPECT_TRUE(contains(squareness(x, y, {}).error().message, "run 2 is partial"));
  EXPECT_TRUE(squareness(x, y, {}, true));
  mdof::Run same = y;
  same.header.state = RunState::complete;
  same.header.provenance.recording_sha256 = "a";
  EXPECT_TRUE(contains(squareness(x, same, {}).error().message, "the same recording"));
}

}  // namespace
}  // namespace mdof::algo
