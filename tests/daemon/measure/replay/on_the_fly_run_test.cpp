// Properties of an on-the-fly run that are not positions or readings.
#include "daemon/measure/replay/on_the_fly_run.h"

#include <gtest/gtest.h>

#include "tests/daemon/measure/test_axis.h"
#include "tests/shown.h"

namespace mdof::daemon {
namespace {

// A movement of 20 mm forward and back at 20 mm/s.
SampleBlock to_and_fro() {
  TestAxis axis(0);
  axis.move_to(20, 1);
  axis.move_to(0, 1);
  return axis.whole();
}

Result<Run> run_on_the_fly(SampleBlock block) {
  PipelineOptions options;
  options.on_the_fly.emplace();
  OnTheFlyRun run = OnTheFlyRun::create(five_probe_rig(), options).value();
  MDOF_CHECK(run.push(block));
  return run.finish();
}

// The encoder is suspect from 0.3 s to 0.4 s after the first scan. In this time the axis moves
// from 6 mm to 8 mm.
TEST(OnTheFlyRun, OmitsPointsWhileTheEncoderIsSuspect) {
  const auto all = run_on_the_fly(to_and_fro());
  ASSERT_TRUE(all) << all.error().message;
  SampleBlock block = to_and_fro();
  block.quality.assign(block.channels.size(), {});
  block.quality[0].assign(block.scans(), Quality::good);
  std::fill_n(block.quality[0].begin() + 300, 101, Quality::suspect);
  const auto run = run_on_the_fly(std::move(block));
  ASSERT_TRUE(run) << run.error().message;
  std::size_t expected = 0;
  for (const auto& p : all->points) {
    const double mm = 1e3 * p.point.position_m;
    if (!(p.point.direction > 0 && mm > 5.4 && mm < 8.6)) ++expected;
  }
  EXPECT_EQ(run->points.size(), expected);
  EXPECT_EQ(all->points.size(), expected + 3) << "at 6, 7 and 8 mm on the way forward";
  const std::string notices = test::shown(run->header.notices);
  EXPECT_NE(notices.find("stops_not_placed daq points=3 from_s=0.27"), std::string::npos)
      << notices;
}

TEST(OnTheFlyRun, AnEncoderThatIsAlwaysSuspectGivesNoRun) {
  SampleBlock block = to_and_fro();
  block.quality.assign(block.channels.size(), {});
  block.quality[0].assign(block.scans(), Quality::suspect);
  const auto run = run_on_the_fly(std::move(block));
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().message.find("were suspect"), std::string::npos) << run.error().message;
}

// A single late sample, for example after a slow USB reply, affects no point.
TEST(OnTheFlyRun, ASingleSuspectScanAffectsNoPoint) {
  SampleBlock block = to_and_fro();
  block.quality.assign(block.channels.size(), {});
  block.quality[0].assign(block.scans(), Quality::good);
  block.quality[0][350] = Quality::suspect;
  EXPECT_EQ(run_on_the_fly(std::move(block))->points.size(),
            run_on_the_fly(to_and_fro())->points.size());
}

TEST(OnTheFlyRun, RejectsMorePointsThanARunHolds) {
  PipelineOptions options;
  options.on_the_fly.emplace();
  options.max_stops = 30;
  OnTheFlyRun run = OnTheFlyRun::create(five_probe_rig(), options).value();
  SampleBlock block = to_and_fro();  // the first pass is finished and has about 20 points
  ASSERT_TRUE(run.push(block));
  TestAxis far(0);
  far.move_to(50, 1);
  far.move_to(0, 1);
  far.move_to(50, 1);
  SampleBlock more = far.whole();
  OnTheFlyRun long_run = OnTheFlyRun::create(five_probe_rig(), options).value();
  const auto refused = long_run.push(more);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("may have at most 30 points"), std::string::npos);
}

}  // namespace
}  // namespace mdof::daemon
