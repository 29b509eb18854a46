// Data that a run contains in addition to its points: its axis, the datum of its positions, lost
// scans and omitted stops.
#include <gtest/gtest.h>

#include "algo/points/flags.h"
#include "tests/daemon/measure/test_axis.h"
#include "tests/shown.h"

namespace mdof::daemon {
namespace {

TestAxis pass_over_five() {
  TestAxis axis;
  axis.pass_both_ways({0, 5, 10, 15, 20});
  return axis;
}

// First scan of each stop (0 ... 9) of pass_over_five().
constexpr std::size_t kToStop = 100, kAtStop = 400;
constexpr std::size_t stop_first_scan(std::size_t stop) {
  return kToStop + stop * (kToStop + kAtStop) + (stop >= 5 ? kToStop : 0);
}

std::string shown_notices(const Run& run) {
  return test::shown(run.header.notices);
}

#define EXPECT_HAS_PART(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

Result<Run> run_of(Pipeline& pipeline, std::vector<SampleBlock> blocks) {
  for (SampleBlock& block : blocks) MDOF_CHECK(pipeline.push(block));
  return pipeline.finish();
}

TEST(PipelineReports, AxisAndFiguresAreThoseOfTheRig) {
  const TestAxis axis = pass_over_five();
  Pipeline pipeline = Pipeline::create(five_probe_rig('Y'), {}).value();
  const auto run = run_of(pipeline, {axis.whole()});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->header.axis, Axis::y);
  ASSERT_FALSE(run->straightness.empty());
  EXPECT_EQ(run->straightness.front().error_key, "EXY_um");
  EXPECT_EQ(shown_notices(*run).find("datum_missing"), std::string::npos);
}

TEST(PipelineReports, ReportsAHeightMapShorterThanTheTravel) {
  const TestAxis axis = pass_over_five();
  Rig rig = five_probe_rig();
  for (const char* id : {"top", "side"}) {
    TargetPlane plane;
    plane.id = id;
    plane.normal = plane.id == "top" ? Vec3{0, 0, 1} : Vec3{0, 1, 0};
    rig.planes.push_back(plane);
  }
  HeightMap& map = rig.planes[1].flatness;
  map = {{-1, 1}, {0}, {0, 0}};
  const auto notices = [&] {
    Pipeline pipeline = Pipeline::create(rig, {}).value();
    return run_of(pipeline, {axis.whole()})->header.notices;
  };
  const Notices before = notices();
  map.first_m = {-1, -30e-3};
  const Notices after = notices();
  ASSERT_EQ(after.size(), before.size() + 1);
  EXPECT_HAS_PART(test::shown(after), "map_too_short side ");
}

TEST(PipelineReports, ReportsPositionsWithoutADatum) {
  const TestAxis axis = pass_over_five();
  PipelineOptions options;
  options.datum.kind = EncoderDatum::Kind::none;
  options.datum.device = "t7";
  Pipeline pipeline = Pipeline::create(five_probe_rig(), options).value();
  const auto run = run_of(pipeline, {axis.whole()});
  ASSERT_TRUE(run);
  EXPECT_EQ(run->header.notices.front(), notice(NoticeCode::datum_missing, "t7"));
}

// The quality of the encoder is suspect during one whole stop.
TEST(PipelineReports, ReportsTheTimeOfAnOmittedStopWithoutPosition) {
  const TestAxis axis = pass_over_five();
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  SampleBlock block = axis.whole();
  block.quality.assign(6, {});
  block.quality[0].assign(block.scans(), Quality::good);
  const std::size_t begin = stop_first_scan(7);
  std::fill_n(block.quality[0].begin() + static_cast<std::ptrdiff_t>(begin - 10), kAtStop + 20,
              Quality::suspect);
  const auto run = run_of(pipeline, {block});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->points.size(), 9u);
  for (const auto& p : run->points)
    EXPECT_FALSE(p.target == 3 && p.point.direction < 0) << "the one at 10 mm on the way back";
  EXPECT_HAS_PART(shown_notices(*run),
                  "stops_not_placed daq points=1 from_s=3.8");  // 3.7 s plus the settling time
}

TEST(PipelineReports, ReportsAGapInTheRecording) {
  const TestAxis axis = pass_over_five();
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  const std::size_t unseen = stop_first_scan(7) - kToStop;
  SampleBlock after = axis.block(unseen + kToStop + 50, axis.scans());
  after.lost = kToStop + 50;
  const auto run = run_of(pipeline, {axis.block(0, unseen), after});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_HAS_PART(shown_notices(*run), "recording_hole length_s=0.15");
}

// The lost scans are fewer than the scans of one window of the stop detection. The axis cannot
// have moved and returned in this time.
TEST(PipelineReports, AFewLostScansDoNotEndAStop) {
  const TestAxis axis = pass_over_five();
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  const std::size_t lost_at = stop_first_scan(7) + 200;
  SampleBlock after = axis.block(lost_at + 20, axis.scans());
  after.lost = 20;
  const auto run = run_of(pipeline, {axis.block(0, lost_at), after});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->header.scans_lost, 20u);
  ASSERT_EQ(run->points.size(), 10u);
  for (const auto& p : run->points)
    EXPECT_FALSE(algo::has_flag(p.point, Flag::approach_assumed)) << p.target;
}

// The axis reverses at its end target and measures this target once.
TEST(PipelineReports, ReportsAnAssumedSequence) {
  TestAxis axis;
  for (const double mm : {0.0, 5.0, 10.0, 15.0, 20.0, 15.0, 10.0, 5.0, 0.0}) axis.stop_at(mm);
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  const auto run = run_of(pipeline, {axis.whole()});
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->points.size(), 9u);
  EXPECT_HAS_PART(shown_notices(*run), "pendulum");
}

// The sampling interval of the second device is longer than max_gap_s.
TEST(PipelineReports, ReportsATooSlowProbeWithTheRemedy) {
  const TestAxis axis = pass_over_five();
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  const SampleBlock side = axis.block(0, axis.scans(), {"D", "E"}, "adam");
  SampleBlock slow{"adam", side.channels, {}, {{}, {}}, {}, 0};
  for (std::size_t i = 0; i < side.scans(); i += 100) append_scans(slow, side, i, i + 1);
  const auto run =
      run_of(pipeline, {axis.block(0, axis.scans(), {kEncoderChannel, "A", "B", "C"}), slow});
  ASSERT_FALSE(run);
  EXPECT_HAS_PART(run.error().message, "D");
  EXPECT_HAS_PART(run.error().message, "max_gap_s");
}

TEST(PipelineReports, TheLiveViewShowsThatAReadingIsMissing) {
  const TestAxis axis = pass_over_five();
  Pipeline view = Pipeline::create(five_probe_rig(), {}).value();
  SampleBlock block = axis.block(0, 300);
  block.quality.assign(6, {});
  block.quality[4].assign(300, Quality::missing);
  block.value[4].assign(300, kNaN);
  ASSERT_TRUE(view.push(block));
  ASSERT_EQ(view.newest().size(), 1u);
  EXPECT_EQ(view.newest().encoder_m.size(), 1u);
  EXPECT_EQ(view.newest().quality_at(3, 0), Quality::missing);
  EXPECT_EQ(view.newest().quality_at(2, 0), Quality::good);
}

}  // namespace
}  // namespace mdof::daemon
