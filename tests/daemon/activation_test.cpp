// A table can be activated only if its data equal the table that was built, and if no run of the
// table was measured while another table was active.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "daemon/history.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/measure/machine/volumetric.h"
#include "schema/base/sqlite/sqlite.h"
#include "tests/daemon/store/fixtures.h"

namespace mdof::daemon {
namespace {

class ActivationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("mdof_active_" + std::to_string(getpid()));
    mdof::Run run;
    run.header.state = RunState::complete;
    run.header.started_utc = "2026-11-22T00:00:00.000Z";
    store_.emplace(open_store());
    table_.runs = {store_->add_run(run).value()};
    table_.position_m = {0.0, 0.01};
    for (auto* group : {&table_.forward, &table_.reverse, &table_.u_forward, &table_.u_reverse})
      for (auto& series : *group) series = {1e-6, 2e-6};
    table_.sha256 = table_sha256(table_);
  }
  void TearDown() override {
    store_.reset();
    std::filesystem::remove_all(folder_);
  }
  store::Store open_store() {
    return store::Store::open(folder_ / "mdof.db", store::Access::read_write).value();
  }
  Result<store::Activation> activated(std::int64_t id) {
    return activate_table(*store_,
                          {id, {false, true}, action_now("compensation.activate", this_process())});
  }

  std::filesystem::path folder_;
  std::optional<store::Store> store_;
  CompensationTable table_;
};

TEST_F(ActivationTest, ActivatesTheTableThatWasBuilt) {
  const auto done = activated(store_->add_table(table_).value());
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_TRUE(done->changed);
}

// The ledger contains the hash of the table that was built. Another table with the same id has
// another hash.
TEST_F(ActivationTest, RejectsAnotherTableWithTheSameId) {
  const auto id = store_->add_table(table_).value();
  store_.reset();
  {
    auto other =
        sqlite::Connection::open(folder_ / "mdof.db", sqlite::OpenMode::read_write).value();
    ASSERT_TRUE(other.execute(
        "DROP TRIGGER compensation_table_no_update; UPDATE compensation_table SET travel = '-'"));
  }
  store_.emplace(open_store());
  const auto done = activated(id);
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("compensation table 1: was changed after it was stored"),
            std::string::npos)
      << done.error().message;
  EXPECT_EQ(store_->generation().value(), 0);
}

// The volumetric table corrects X and Y (its grid has one position of Z) from 10:00 to 12:00.
TEST_F(ActivationTest, RunsMeasuredWithAVolumetricTableAreNamed) {
  const auto volume = store_->add_volumetric(store::make_volume()).value();
  ASSERT_TRUE(store_->change_volumetric(volume, "me", "2026-11-22T10:00:00.000Z"));
  ASSERT_TRUE(store_->change_volumetric(std::nullopt, "me", "2026-11-22T12:00:00.000Z"));
  const auto named = [&](Axis axis, const char* hour, const char* kind = "recording",
                         std::int64_t minutes = 0) {
    mdof::Run run;
    run.points.resize(2);
    for (MeasuredPoint& point : run.points) {
      point.point.probe_m = {0};
      point.point.begin_ns = point.point.end_ns = 7;
    }
    run.points[1].point.end_ns += minutes * 60'000'000'000;
    run.header.axis = axis;
    run.header.state = RunState::complete;
    run.header.started_utc = std::string("2026-11-22T") + hour + ":00:00.000Z";
    run.header.provenance.recording_kind = kind;
    run.header.start_known = run.header.provenance.recording_kind == "recording";
    const auto id = store_->add_run(run).value();
    const Notices found = doubtful_notices(*store_, store::make_volume({id})).value();
    return std::count(
        found.begin(), found.end(),
        notice(NoticeCode::measured_with_table, "", {{"run", id}, {"table", volume}}));
  };
  EXPECT_EQ(named(Axis::x, "09"), 0);
  EXPECT_EQ(named(Axis::x, "09", "recording", 59), 0);
  EXPECT_EQ(named(Axis::x, "09", "recording", 61), 1) << "activated during the run";
  EXPECT_EQ(named(Axis::x, "12", "recording", 600), 0) << "deactivated before the run";
  EXPECT_EQ(named(Axis::x, "10"), 1);
  EXPECT_EQ(named(Axis::y, "11"), 1);
  EXPECT_EQ(named(Axis::z, "11"), 0) << "the correction is the same at all positions of Z";
  EXPECT_EQ(named(Axis::x, "11", "csv"), 0) << "a log does not state when it was measured";
  EXPECT_EQ(named(Axis::x, "12"), 0);
}

// Run 2 contains the points of run 1, during which the table of axis X was active.
TEST_F(ActivationTest, ARunThatGoesOnHasTheTablesOfItsFirstPart) {
  const auto table = store_->add_table(table_).value();
  ASSERT_TRUE(store_->activate(table, "me", "2026-11-22T10:00:00.000Z"));
  ASSERT_TRUE(store_->deactivate(Axis::x, "me", "2026-11-22T11:00:00.000Z"));
  mdof::Run run;
  run.header.state = RunState::partial;
  run.header.started_utc = "2026-11-22T10:30:00.000Z";
  run.header.start_known = true;
  run.header.provenance.recording_kind = "recording";
  const auto first = store_->add_run(run).value();
  run.header.state = RunState::complete;
  run.header.started_utc = "2026-11-22T12:00:00.000Z";
  run.header.supersedes = first;
  run.header.notices = {notice(NoticeCode::run_goes_on, "", {{"run", first}, {"datum", ""}})};
  const auto whole = store_->add_run(run).value();
  run.header.supersedes = whole;
  run.header.notices = {};
  const auto measured_again = store_->add_run(run).value();
  const auto with_table = [&](std::int64_t id) {
    const Notices found = source_run_notices(*store_, {id}).value();
    return std::count(found.begin(), found.end(),
                      notice(NoticeCode::measured_with_table, "", {{"run", id}, {"table", table}}));
  };
  EXPECT_EQ(with_table(first), 1);
  EXPECT_EQ(with_table(whole), 1);
  EXPECT_EQ(with_table(measured_again), 0);
}

TEST_F(ActivationTest, RunsOfDifferentRigsNeedConfirmation) {
  std::vector<mdof::Run> runs(2);
  for (mdof::Run& run : runs)
    run.header.provenance.rig_text = "axis = \"X\"\n[report]\ndate = \"2026-11-20\"\n";
  runs[1].header.provenance.rig_text = "axis = \"X\"  # the same\n";
  const auto differ = [&] {
    const Notices found = differences_of_runs(runs).value();
    return std::count(found.begin(), found.end(), notice(NoticeCode::rigs_differ));
  };
  EXPECT_EQ(differ(), 0);
  runs[1].header.provenance.rig_text = "axis = \"X\"\n[[probe]]\nid = \"A\"\n";
  EXPECT_EQ(differ(), 1);
}

}  // namespace
}  // namespace mdof::daemon
