// A run from the user's view: start, measurement and end. Other causes may also end a run.
#include "daemon/station/station.h"

#include "daemon/measure/replay/replay.h"
#include "daemon/station/resume.h"
#include "tests/daemon/station/fed_station.h"

namespace mdof::daemon {
namespace {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

const std::vector<double> kTargets_mm = {0, 5, 10};

class StationTest : public FedStation {
 protected:
  StationTest() { axis_.pass_both_ways(kTargets_mm); }
  static RunRequest both_ways_once() {
    RunRequest request;
    for (const double mm : kTargets_mm) request.targets_m.push_back(1e-3 * mm);
    request.repeats = 1;
    request.note = "of a test";
    return request;
  }
  void expect_six_true_points(const mdof::Run& run) {
    ASSERT_EQ(run.points.size(), 6u);
    for (const auto& p : run.points) expect_true_errors(p, 1e3 * p.target_m);
  }
  TestAxis axis_;
};

TEST_F(StationTest, ARunIsOnTheDiskBeforeItsStartIsAnswered) {
  EXPECT_EQ(station_->run(), 0);
  const auto id = start(both_ways_once());
  ASSERT_TRUE(id) << id.error().message;
  EXPECT_EQ(station_->run(), *id);
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::open);
  EXPECT_EQ(run.header.note, "of a test");
  EXPECT_EQ(run.header.axis, Axis::x);
  EXPECT_EQ(run.header.provenance.rig_text, five_probe_rig().text);
  EXPECT_EQ(run.header.provenance.configuration, "# mdofd.toml of a test\n");
  EXPECT_EQ(run.header.provenance.recording_kind, "recording");
  EXPECT_TRUE(std::filesystem::exists(run.header.provenance.recording_path));
  EXPECT_SAYS(events_.wait_for({"\"started\""}), "\"run\":" + std::to_string(*id));
}

TEST_F(StationTest, ARunAndAReplayOfItsRecordingHaveTheSameBits) {
  const auto id = start();
  give(axis_);
  const auto read = stop();
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(*read, *id);
  EXPECT_EQ(station_->run(), 0);
  const mdof::Run run = stored(*read);
  EXPECT_EQ(run.header.state, RunState::complete);
  expect_six_true_points(run);
  EXPECT_EQ(run.header.scans, axis_.scans());
  EXPECT_FALSE(run.straightness.empty());
  auto log = ReplayLog::open(run.header.provenance.recording_path);
  ASSERT_TRUE(log) << log.error().message;
  const auto again = replay(*log, five_probe_rig(), log->asked_for()->options);
  ASSERT_TRUE(again) << again.error().message;
  ASSERT_EQ(again->points.size(), run.points.size());
  for (std::size_t i = 0; i < run.points.size(); ++i)
    EXPECT_EQ(again->points[i].errors.local, run.points[i].errors.local);
  EXPECT_EQ(log->sha256(), run.header.provenance.recording_sha256);
}

TEST_F(StationTest, ARunEndsByItselfAtItsLimitOfStops) {
  options_.max_stops = 3;
  make_station();
  const auto id = start();
  give(axis_);
  ASSERT_FALSE(events_.wait_for({"\"ended\""}).empty());
  EXPECT_EQ(station_->run(), 0);
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.points.size(), 3u);
  EXPECT_SAYS(notices(run), "stops_over_limit stops=3 ");
}

TEST_F(StationTest, PointsAreReportedAfterStorageAndTheEndIsLast) {
  const auto id = start(both_ways_once());
  give(axis_, 0, 1400);  // three stops; the third is still in progress
  EXPECT_SAYS(events_.wait_for({"\"points\":["}), "\"offset\":0");
  EXPECT_GE(stored(*id).points.size(), 1u);
  const std::string progress = events_.wait_for({"\"progress\"", "\"done\":2"});
  EXPECT_SAYS(progress, "\"of\":6");
  EXPECT_SAYS(progress, "\"awaited_mm\":10");
  EXPECT_EQ(events_.count("\"ended\""), 0u);
  give(axis_, 1400);
  EXPECT_SAYS(events_.wait_for({"\"ended\""}), "\"state\":\"complete\"");
}

// A stop that is near no target is reported while the run continues, and only once. In a run
// without targets, each stop is a point.
TEST_F(StationTest, AStopNearNoTargetIsReportedAtOnce) {
  RunRequest request = both_ways_once();
  const double left_out_m = request.targets_m[1];
  request.targets_m.erase(request.targets_m.begin() + 1);
  ASSERT_TRUE(start(request));
  give(axis_, 0, 1400);
  const std::string told = events_.wait_for({"\"left_out\""});
  EXPECT_SAYS(told, "\"code\":\"stop_near_no_target\"");
  EXPECT_SAYS(told, "\"position_mm\":" + std::to_string(static_cast<int>(left_out_m * 1e3)));
  EXPECT_EQ(events_.count("\"ended\""), 0u);
  ASSERT_TRUE(stop());
  EXPECT_EQ(events_.count("\"left_out\""), 1u);
}

TEST_F(StationTest, ARunEndsByItselfWhenAllTargetsAreMeasured) {
  const auto id = start(both_ways_once());
  give(axis_);
  TestAxis more(-1);
  ASSERT_FALSE(events_.wait_for({"\"ended\""}).empty());
  for (int i = 0; i < 500 && station_->run() != 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(station_->run(), 0);
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::complete);
  expect_six_true_points(run);
  const auto late = stop();
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::not_found);
}

TEST_F(StationTest, RejectsASecondRunAtTheSameTime) {
  const auto id = start();
  const auto second = start();
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::conflict);
  EXPECT_SAYS(second.error().message, "axis X");
  EXPECT_SAYS(second.error().message, "stop this run first");
  EXPECT_EQ(station_->run(), *id);
  give(axis_);
  ASSERT_TRUE(stop());
  EXPECT_EQ(start().value_or(0), *id + 1);
}

TEST_F(StationTest, WithoutARunStopIsNotFound) {
  const auto stopped = stop();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, ErrorCode::not_found);
  EXPECT_SAYS(stopped.error().message, "no run of axis X");
}

TEST_F(StationTest, AnAbortedRunKeepsItsPointsAndItsNotice) {
  const auto id = start(both_ways_once());
  give(axis_, 0, 1400);
  ASSERT_TRUE(stop(true));
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::aborted);
  EXPECT_GE(run.points.size(), 2u);
  EXPECT_SAYS(notices(run), "aborted\n");
  EXPECT_SAYS(events_.wait_for({"\"ended\""}), "\"state\":\"aborted\"");
}

TEST_F(StationTest, ARunThatMeasuredNothingFailsWithTheReason) {
  const auto id = start();
  TestAxis parked(3);
  parked.stand(2);
  give(parked);
  ASSERT_TRUE(stop());
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::failed);
  EXPECT_TRUE(run.points.empty());
  EXPECT_SAYS(notices(run), "the encoder stays at 3 mm");
}

TEST_F(StationTest, AnEarlyStopGivesAPartialRunThatCanBeResumed) {
  const auto id = start(both_ways_once());
  give(axis_, 0, 1700);  // three stops and the movement after them
  ASSERT_TRUE(stop());
  const mdof::Run first = stored(*id);
  EXPECT_EQ(first.header.state, RunState::partial);
  EXPECT_SAYS(notices(first), "points_missing missing=3 of=6 ");
  EXPECT_SAYS(notices(first), "run_can_go_on");

  auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
  auto request = request_to_resume(*store, *id, station_->config());
  ASSERT_TRUE(request) << request.error().message;
  EXPECT_EQ(request->targets_m, both_ways_once().targets_m);
  EXPECT_EQ(request->repeats, 1);
  EXPECT_EQ(request->note, "of a test");
  const auto next = start(*request);
  ASSERT_TRUE(next) << next.error().message;
  EXPECT_GT(*next, *id);
  give(axis_, 1400);  // from the last stop to the end
  ASSERT_FALSE(events_.wait_for({"\"ended\"", "\"complete\""}).empty());
  const mdof::Run whole = stored(*next);
  EXPECT_EQ(whole.header.state, RunState::complete);
  EXPECT_EQ(whole.header.supersedes, *id);
  EXPECT_SAYS(notices(whole), "run_goes_on run=" + std::to_string(*id));
  for (const auto& p : whole.points) expect_true_errors(p, 1e3 * p.target_m);
  EXPECT_GE(whole.points.size(), 6u);

  for (const auto& [run, why] :
       {std::pair(*id, "supersedes this run"), std::pair(*next, "this run is complete")}) {
    const auto refused = request_to_resume(*store, run, station_->config());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::conflict);
    EXPECT_SAYS(refused.error().message, why);
  }
}

TEST_F(StationTest, ARunInProgressOrOfAnotherRigIsNotResumed) {
  const auto id = start(both_ways_once());
  auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
  EXPECT_SAYS(request_to_resume(*store, *id, station_->config()).error().message,
              "this run is under way");
  give(axis_, 0, 1400);
  ASSERT_TRUE(stop());
  AxisConfig other = station_->config();
  other.rig.text += "# shimmed\n";
  EXPECT_SAYS(request_to_resume(*store, *id, other).error().message, "the rig was changed");
  EXPECT_EQ(request_to_resume(*store, 99, other).error().code, ErrorCode::not_found);
  EXPECT_TRUE(request_to_resume(*store, *id, station_->config()));
}

TEST_F(StationTest, ARunWithoutItsRecordingIsNotResumed) {
  const auto id = start(both_ways_once());
  give(axis_, 0, 1400);
  ASSERT_TRUE(stop());
  auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
  const auto request = request_to_resume(*store, *id, station_->config());
  std::filesystem::remove(stored(*id).header.provenance.recording_path);
  const auto resumed = start(*request);
  ASSERT_FALSE(resumed);
  EXPECT_SAYS(resumed.error().message, ".mdofrec");
  EXPECT_EQ(station_->run(), 0);
  EXPECT_TRUE(start());
}

TEST_F(StationTest, AStorageFailureEndsTheRunWithTheReason) {
  const auto id = start(both_ways_once());
  give(axis_, 0, 1400);
  station_->storage_failed(*id + 1, Error{ErrorCode::io, "of another run"});
  station_->storage_failed(*id, Error{ErrorCode::io, "the disk is full"});
  EXPECT_SAYS(events_.wait_for({"\"ended\""}), "\"state\":\"failed\"");
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::failed);
  EXPECT_SAYS(notices(run), "the disk is full");
  EXPECT_EQ(notices(run).find("of another run"), std::string::npos);
  EXPECT_TRUE(start()) << "the axis is free again";
}

}  // namespace
}  // namespace mdof::daemon
