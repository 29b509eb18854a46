// An encoder with a reference mark, in three cases: before the axis passes the mark, after it, and
// during a run.
#include "daemon/measure/replay/request_json.h"
#include "daemon/station/resume.h"
#include "daemon/words/error_text.h"
#include "tests/daemon/station/fed_station.h"

namespace mdof::daemon {
namespace {

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

constexpr double kMark_mm = 12.5;

class StationMark : public FedStation {
 protected:
  StationMark() { axis_.pass_both_ways({0, 5, 10}); }
  void SetUp() override {
    FedStation::SetUp();
    make_station(true, kMark_mm);
  }
  // Feeds 100 scans after the mark and waits until the station has the datum.
  void pass_mark(std::size_t scan = 0) {
    feed_->pass_mark();
    give(axis_, scan, scan + 100);
    wait_for([this] { return kind() == EncoderDatum::Kind::index; });
  }
  void wait_for(const std::function<bool()>& condition) {
    for (int i = 0; i < 2000 && !condition(); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(condition());
  }
  EncoderDatum::Kind kind() { return station_->encoder().datum.kind; }
  static EncoderDatum datum_of(const mdof::Run& run) {
    return read_options_json(run.header.provenance.options_json, {}).value().datum;
  }
  static Notices datum_notices_of(const mdof::Run& run) {
    Notices found = run.header.notices;
    std::erase_if(found, [](const Notice& n) { return n.code != NoticeCode::datum_missing; });
    return found;
  }
  mdof::Run measured() {
    const auto id = start();
    EXPECT_TRUE(id) << id.error().message;
    give(axis_);
    const auto ended = stop();
    EXPECT_TRUE(ended) << ended.error().message;
    return stored(ended.value_or(0));
  }
  std::string resume_refusal(std::int64_t run) {
    auto reader = store::Store::open(folder_ / "mdof.db", store::Access::read_only).value();
    const auto request = request_to_resume(reader, run, station_->config());
    if (!request) return "no request: " + request.error().message;
    const auto id = start(*request);
    return id ? "goes on" : words::text(id.error());
  }
  TestAxis axis_;
};

TEST_F(StationMark, OnlyARunAfterTheMarkHasMachinePositions) {
  mdof::Run run = measured();
  EXPECT_EQ(datum_of(run).kind, EncoderDatum::Kind::none);
  EXPECT_EQ(datum_notices_of(run), Notices{notice(NoticeCode::datum_missing, "daq")});
  EXPECT_NEAR(run.points[1].point.position_m, 0.005, 1e-6);

  pass_mark();
  EXPECT_SAYS(station_->encoder().note, "reference mark at 12.5 mm, passed on 2");
  run = measured();
  EXPECT_EQ(run.header.state, RunState::complete) << notices(run);
  EXPECT_EQ(datum_notices_of(run), Notices());
  const EncoderDatum datum = datum_of(run);
  EXPECT_EQ(datum.kind, EncoderDatum::Kind::index);
  EXPECT_EQ(datum.device, "daq");
  EXPECT_EQ(datum_text(datum).substr(0, 25), "reference mark at 12.5 mm");
  ASSERT_EQ(run.points.size(), 6u);
  EXPECT_NEAR(run.points[1].point.position_m, 0.0175, 1e-6);
}

// The axis has not passed the mark since the new process started.
TEST_F(StationMark, AfterARestartTheMarkMustBePassedAgain) {
  pass_mark();
  make_station(true, kMark_mm);
  EXPECT_EQ(kind(), EncoderDatum::Kind::none);
  EXPECT_SAYS(station_->encoder().note, "move the axis over its reference mark");
}

TEST_F(StationMark, ARunEndsWhereTheMarkIsPassed) {
  const auto id = start();
  ASSERT_TRUE(id);
  give(axis_, 0, 1500);
  feed_->pass_mark();
  give(axis_, 1500);
  wait_for([this] { return station_->run() == 0; });
  const mdof::Run run = stored(*id);
  EXPECT_EQ(run.header.state, RunState::aborted);
  EXPECT_SAYS(notices(run), "reference_mark_passed");
  EXPECT_EQ(datum_of(run).kind, EncoderDatum::Kind::none);
  for (const auto& p : run.points) EXPECT_LT(p.point.position_m, 0.0101);
  EXPECT_LE(run.header.scans, 1500u);
  // A run may not contain positions of two datums.
  EXPECT_SAYS(resume_refusal(*id), "start a new run");
  EXPECT_EQ(measured().header.state, RunState::complete);
}

TEST_F(StationMark, AMarkPassedBeforeTheFirstScanEndsTheRunToo) {
  std::promise<void> go_on;
  ASSERT_TRUE(keeper_->post([&](store::Store&) { go_on.get_future().wait(); }));
  std::promise<Result<std::int64_t>> begun;
  station_->start_run({}, [&](const auto& id) { begun.set_value(id); });
  pass_mark();
  go_on.set_value();
  const auto id = begun.get_future().get();
  ASSERT_TRUE(id);
  wait_for([this] { return station_->run() == 0; });
  const mdof::Run run = stored(*id);
  EXPECT_EQ(datum_of(run).kind, EncoderDatum::Kind::none);
  EXPECT_EQ(run.header.state, RunState::aborted);
}

TEST_F(StationMark, ARunFromTheMarkResumesOnlyFromTheMark) {
  pass_mark();
  const auto id = start();
  give(axis_, 0, 2500);
  ASSERT_TRUE(stop(true));
  make_station(true, kMark_mm);
  EXPECT_SAYS(resume_refusal(*id), "move the axis over its reference mark");
  pass_mark();
  EXPECT_EQ(resume_refusal(*id), "goes on");
}

TEST_F(StationMark, AfterAPowerLossTheSameMarkIsTheSameDatum) {
  pass_mark();
  const auto id = start();
  give(axis_, 0, 500);
  feed_->lose_datum();
  EXPECT_SAYS(events_.wait_for_trouble({"datum is lost"}), "suspect");
  wait_for([this] { return kind() == EncoderDatum::Kind::none; });
  pass_mark(600);
  EXPECT_EQ(station_->encoder().datum.offset_m, 1e-3 * kMark_mm);
  wait_for([this] { return station_->devices()[0].standing.empty(); });
  EXPECT_EQ(station_->run(), *id);
  // The datum is lost again, and the loss must be reported again.
  feed_->lose_datum();
  wait_for([this] { return kind() == EncoderDatum::Kind::none; });
  const auto ended = stop(true);
  EXPECT_TRUE(ended) << ended.error().message;
}

}  // namespace
}  // namespace mdof::daemon
