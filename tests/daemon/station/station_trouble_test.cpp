// Interruptions of a run: a device is lost and returns, the program ends, or a log replaces the
// device.
#include "daemon/station/resume.h"
#include "drivers/clock/monotonic.h"
#include "tests/daemon/station/fed_station.h"

namespace mdof::daemon {
namespace {

#define EXPECT_TEXT_CONTAINS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

class StationTrouble : public FedStation {
 protected:
  StationTrouble() { axis_.pass_both_ways({0, 5, 10}); }
  static constexpr std::size_t kAtThird = 1400;  // scan at which the third stop is in progress
  TestAxis axis_;
};

TEST_F(StationTrouble, ADeviceLossLosesOnlyThePointsOfThatTime) {
  const auto id = start();
  give(axis_, 0, kAtThird);
  feed_->go();
  EXPECT_TEXT_CONTAINS(events_.wait_for_trouble({"lost"}), std::to_string(*id) + " device \"daq\"");
  EXPECT_EQ(station_->devices().front().state, "failed: reopening");
  EXPECT_EQ(station_->run(), *id) << "the run goes on";
  feed_->come_back();
  give(axis_, kAtThird + 300);  // 0.3 s of samples are missing
  ASSERT_FALSE(events_.wait_for_trouble({"back"}).empty());
  const auto read = stop();  // the approach of the last stop is known only now
  ASSERT_TRUE(read) << read.error().message;
  const mdof::Run run = stored(*read);
  EXPECT_EQ(run.header.state, RunState::complete) << notices(run);
  EXPECT_GE(run.points.size(), 5u);
  for (const auto& p : run.points) expect_true_errors(p, 1e3 * p.target_m);
  EXPECT_GE(run.header.scans_lost, 299u);
  EXPECT_TEXT_CONTAINS(notices(run), "device_trouble daq kind=lost");
  EXPECT_TEXT_CONTAINS(notices(run), "10.0.0.9: connection lost");
}

TEST_F(StationTrouble, ARunWithoutItsDeviceCanBeStopped) {
  const auto id = start();
  give(axis_, 0, kAtThird);
  feed_->go();
  ASSERT_FALSE(events_.wait_for_trouble({"lost"}).empty());
  ASSERT_TRUE(stop());
  const mdof::Run run = stored(*id);
  EXPECT_GE(run.points.size(), 2u);
  EXPECT_TEXT_CONTAINS(notices(run), "connection lost");
  const auto next = start();
  ASSERT_TRUE(next);
  ASSERT_TRUE(stop());
  EXPECT_EQ(stored(*next).header.state, RunState::failed);
  EXPECT_TEXT_CONTAINS(notices(stored(*next)), "no samples");
}

TEST_F(StationTrouble, TheEndOfTheProgramEndsAnOpenRunAsAborted) {
  const auto id = start();
  give(axis_, 0, kAtThird);
  ASSERT_FALSE(events_.wait_for({"\"points\":["}).empty());
  station_.reset();
  keeper_.reset();
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::aborted);
  EXPECT_TEXT_CONTAINS(notices(run), "daemon_stopped");
  EXPECT_GE(run.points.size(), 2u);
  EXPECT_EQ(run.header.provenance.recording_sha256.size(), 64u) << "its recording is sealed";
}

TEST_F(StationTrouble, TheProgramEndsInEveryStateWithoutALongWait) {
  const auto begin = std::chrono::steady_clock::now();
  station_.reset();  // ends without a run
  make_station();
  feed_->go();  // the device is lost
  ASSERT_FALSE(events_.wait_for_trouble({"lost"}).empty());
  ASSERT_TRUE(start());  // a run starts although the device is lost; the program then ends
  station_.reset();
  make_station();
  ASSERT_TRUE(start());
  station_->stop_run(false, action_now("run.stop", this_process()), {});
  station_.reset();  // ends while a run is ending
  make_station();
  station_->start_run({}, [](const auto&) {});
  station_.reset();  // ends while a run is starting
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
  keeper_.reset();
  auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
  const auto headers = store->list_runs(0, 10).value();
  EXPECT_GE(headers.size(), 2u);
  for (const auto& header : headers) EXPECT_NE(header.state, RunState::open) << header.id;
}

TEST_F(StationTrouble, ProgramEndDuringResumeLeavesTheRunAborted) {
  const auto id = start();
  for (int pass = 0; pass < 5; ++pass) axis_.pass_both_ways({0, 5, 10});
  give(axis_, 0, axis_.scans());
  ASSERT_TRUE(stop(true));
  auto store = store::Store::open(folder_ / "mdof.db", store::Access::read_only);
  const auto request = request_to_resume(*store, *id, station_->config());
  ASSERT_TRUE(request) << request.error().message;
  std::promise<Result<std::int64_t>> resumed;
  station_->start_run(*request, [&](const auto& run) { resumed.set_value(run); });
  station_.reset();
  const auto next = resumed.get_future().get();  // the request is answered in any case
  keeper_.reset();
  EXPECT_EQ(stored(*id).header.state, RunState::aborted);
  if (next)
    EXPECT_EQ(stored(*next).header.state, RunState::aborted);
  else
    EXPECT_TRUE(request_to_resume(*store, *id, AxisConfig{five_probe_rig(), {fed_by(feed_)}}));
}

TEST_F(StationTrouble, ALogIsReadOnceForEachRunAndEndsIt) {
  station_.reset();
  make_station(false);
  feed_->give(axis_.whole());
  feed_->end();
  for (int pass = 0; pass < 2; ++pass) {
    EXPECT_EQ(station_->devices().front().scans, pass == 0 ? 0u : axis_.scans());
    const auto id = start();
    ASSERT_TRUE(id) << id.error().message;
    const std::string run = "\"run\":" + std::to_string(*id);
    EXPECT_TEXT_CONTAINS(events_.wait_for({"\"ended\"", run}), pass == 0 ? "complete" : "failed");
    const mdof::Run read = stored(*id);
    // In the second pass the log has no samples.
    EXPECT_EQ(read.points.size(), pass == 0 ? 6u : 0u);
    EXPECT_EQ(read.header.provenance.recording_kind, "replay");
    EXPECT_EQ(read.header.provenance.recording_path, "/logs/of_a_test.csv");
  }
  EXPECT_FALSE(std::filesystem::exists(folder_ / "recordings"));
}

TEST_F(StationTrouble, TheLiveViewShowsTheAxisWithAndWithoutARun) {
  station_->watch(std::chrono::milliseconds(20));
  give(axis_, 0, kAtThird);
  const std::string live = events_.wait_for_live({"\"run\":null"});
  EXPECT_TEXT_CONTAINS(live, "\"axis\":\"X\"");
  const auto id = start();
  give(axis_, kAtThird);
  EXPECT_FALSE(events_.wait_for_live({"\"run\":" + std::to_string(*id)}).empty());
  EXPECT_FALSE(events_.wait_for_live({"\"stale\":true"}).empty()) << "nothing comes any more";
}

// While one device is silent, the frames of the others arrive late, but at their full rate.
TEST_F(StationTrouble, ReadingsOfThreeSecondsAgoAreStaleAlthoughTheyJustArrived) {
  station_->watch(std::chrono::milliseconds(20));
  const auto give_until = [&](std::int64_t end_ns) {
    SampleBlock block = axis_.block(0, 100);
    const std::int64_t shift_ns = end_ns - block.time_ns.back();
    for (auto& time_ns : block.time_ns) time_ns += shift_ns;
    feed_->give(block);
    feed_->wait_until_read();
  };
  give_until(drivers::monotonic_ns() - 3'000'000'000);
  const std::string late = events_.wait_for_live({"\"axis\":\"X\""});
  EXPECT_TEXT_CONTAINS(late, "\"stale\":true");
  EXPECT_TEXT_CONTAINS(late, "\"age_s\":3.");
  std::string fresh;
  for (int i = 0; i < 20 && fresh.empty();
       ++i) {  // repeated, because a busy machine may be too slow
    give_until(drivers::monotonic_ns());
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    fresh = events_.find_live({"\"stale\":false", "\"age_s\":0."});
  }
  EXPECT_FALSE(fresh.empty());
}

// For an encoder that counts from its position at switch-on.
class StationDatum : public FedStation {
 protected:
  // Two seconds of samples at rest, until now. After this a user can set the position of the axis.
  void rest_until_now(double mm) {
    TestAxis parked(mm);
    parked.stand(2);
    SampleBlock block = parked.whole();
    const std::int64_t shift_ns = drivers::monotonic_ns() - block.time_ns.back();
    for (auto& time_ns : block.time_ns) time_ns += shift_ns;
    feed_->give(block);
    feed_->wait_until_read();
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  Result<EncoderDatum> set(double mm) {
    std::promise<Result<EncoderDatum>> done;
    const HistoryEntry action{"encoder.set", {1000, 1000, 4711, "anna"}, "2026-11-23T08:00:00Z"};
    station_->set_encoder(1e-3 * mm, action, [&](const auto& datum) { done.set_value(datum); });
    return done.get_future().get();
  }
};

TEST_F(StationDatum, IsThePositionThatTheUserSets) {
  EXPECT_EQ(station_->encoder().datum.kind, EncoderDatum::Kind::none);
  const auto nothing = set(12.5);
  ASSERT_FALSE(nothing);
  EXPECT_TEXT_CONTAINS(nothing.error().message, "the encoder has sent no sample");
  EXPECT_EQ(station_->run(), 0);
  Result<EncoderDatum> datum = nothing;
  for (int i = 0; i < 20 && !datum; ++i) {  // repeated, because a busy machine may be too slow
    rest_until_now(2);
    datum = set(12.5);
  }
  ASSERT_TRUE(datum) << datum.error().message;
  EXPECT_NEAR(datum->offset_m, 10.5e-3, 1e-12);
  EXPECT_EQ(station_->encoder().datum.kind, EncoderDatum::Kind::set);
  EXPECT_EQ(station_->encoder().datum.by, "uid 1000 (anna) gid 1000 pid 4711");
  EXPECT_EQ(station_->run(), 0) << "the axis is free for a run";
}

TEST_F(StationDatum, CannotBeSetDuringARun) {
  rest_until_now(2);
  ASSERT_TRUE(start());
  const auto datum = set(12.5);
  ASSERT_FALSE(datum);
  EXPECT_EQ(datum.error().code, ErrorCode::conflict);
  EXPECT_TEXT_CONTAINS(datum.error().message, "stop this run first");
  EXPECT_EQ(station_->encoder().datum.kind, EncoderDatum::Kind::none);
}

TEST_F(StationDatum, CannotBeSetForALog) {
  station_.reset();
  make_station(false);
  const auto datum = set(12.5);
  ASSERT_FALSE(datum);
  EXPECT_EQ(datum.error().code, ErrorCode::conflict);
  EXPECT_TEXT_CONTAINS(datum.error().message, "is read from a log");
}

}  // namespace
}  // namespace mdof::daemon
