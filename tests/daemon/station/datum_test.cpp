// An encoder that starts again to count from 0 during a run. Earlier points remain valid, and
// later points get no wrong position.
#include "daemon/measure/pipeline.h"

#include <gtest/gtest.h>

#include <cmath>

#include "schema/rig/rig.h"
#include "tests/shown.h"

namespace mdof::daemon {
namespace {

constexpr int kStop = 500, kMove = 100;  // numbers of scans, at 1 kHz

// Stops at -1, 0, 5, 10, 15, 20, 21 mm and at the same positions on the way back. From stop
// `restart` on, the encoder shows 7 mm less and is suspect.
class LostCountAxis {
 public:
  explicit LostCountAxis(int restart) {
    const double stops_mm[] = {-1, 0, 5, 10, 15, 20, 21, 20, 15, 10, 5, 0, -1};
    double from_mm = stops_mm[0];
    int stop = 0;
    for (const double to_mm : stops_mm) {
      for (int i = 0; i < kMove + kStop; ++i) {
        const double share = std::min(1.0, static_cast<double>(i) / kMove);
        add(from_mm + (to_mm - from_mm) * share, stop >= restart);
      }
      from_mm = to_mm;
      ++stop;
    }
  }
  std::size_t scans() const { return encoder_mm_.size(); }

  SampleBlock block(std::size_t begin, std::size_t end) const {
    SampleBlock block;
    block.device = "t7";
    block.channels = {{kEncoderChannel, Unit::mm}};
    for (const char* id : {"A", "B", "C", "D", "E"}) block.channels.push_back({id, Unit::um});
    block.value.resize(6);
    block.quality.resize(6);
    for (std::size_t i = begin; i < end; ++i) {
      block.time_ns.push_back(static_cast<std::int64_t>(i + 1) * 1'000'000);
      block.value[0].push_back(encoder_mm_[i]);
      block.quality[0].push_back(suspect_[i] ? Quality::suspect : Quality::good);
      for (std::size_t c = 1; c < 6; ++c) {
        block.value[c].push_back(static_cast<double>(c) + 0.001 * static_cast<double>(i % 7));
        block.quality[c].push_back(Quality::good);
      }
    }
    return block;
  }

 private:
  void add(double mm, bool lost) {
    encoder_mm_.push_back(lost ? mm - 7 : mm);
    suspect_.push_back(lost);
  }
  std::vector<double> encoder_mm_;
  std::vector<bool> suspect_;
};

Result<Run> measured(const LostCountAxis& axis, std::size_t scans, std::size_t per_block,
                     std::vector<double> targets_m = {}) {
  MDOF_TRY(const Rig rig, load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml"));
  PipelineOptions options;
  options.sequence.targets_m = std::move(targets_m);
  MDOF_TRY(Pipeline pipeline, Pipeline::create(rig, options));
  for (std::size_t begin = 0; begin < scans; begin += per_block) {
    SampleBlock block = axis.block(begin, std::min(begin + per_block, scans));
    MDOF_CHECK(pipeline.push(block));
  }
  return pipeline.finish();
}

std::string notices(const Run& run) {
  return test::shown(run.header.notices);
}

constexpr int kRestart = 8;  // the stop at 15 mm on the way back
constexpr std::size_t kBefore = kRestart * (kMove + kStop);

TEST(Datum, StopsAfterItsLossAreOmittedAndCounted) {
  const LostCountAxis axis(kRestart);
  for (const std::size_t per_block : {1u, 64u, 100'000u}) {
    const auto whole = measured(axis, axis.scans(), per_block);
    const auto before = measured(axis, kBefore, per_block);
    ASSERT_TRUE(whole) << whole.error().message;
    ASSERT_TRUE(before) << before.error().message;
    ASSERT_EQ(whole->points.size(), before->points.size());
    for (std::size_t i = 0; i < whole->points.size(); ++i) {
      EXPECT_EQ(whole->points[i].target, before->points[i].target);
      EXPECT_EQ(whole->points[i].point.position_m, before->points[i].point.position_m);
      EXPECT_TRUE(whole->points[i].errors.valid);
    }
    const std::string reported = notices(*whole);
    EXPECT_NE(reported.find("stops_not_placed"), std::string::npos) << reported;
    EXPECT_NE(reported.find("stops_not_placed t7"), std::string::npos) << reported;
    EXPECT_EQ(reported.find("five probes"), std::string::npos) << reported;
    EXPECT_EQ(notices(*before).find("stops_not_placed"), std::string::npos);
  }
}

TEST(Datum, AWrongPositionIsNotAssignedToATarget) {
  const LostCountAxis axis(kRestart);  // the encoder shows 7 mm less: 8 mm at 15 mm
  const auto run = measured(axis, axis.scans(), 100, {0, 0.005, 0.008, 0.010, 0.015, 0.020});
  ASSERT_TRUE(run) << run.error().message;
  for (const auto& p : run->points) EXPECT_NE(p.target, 3) << "a stop at 15 mm counted as 8 mm";
}

TEST(Datum, LossFromTheStartIsTheReasonOfTheFailure) {
  const LostCountAxis axis(0);
  const auto run = measured(axis, axis.scans(), 100);
  ASSERT_FALSE(run);
  EXPECT_NE(run.error().message.find("no valid position"), std::string::npos)
      << run.error().message;
}

TEST(Datum, SingleSuspectReadingsOmitNoStop) {
  const LostCountAxis axis(99);
  const Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  Pipeline pipeline = Pipeline::create(rig, {}).value();
  for (std::size_t begin = 0; begin < axis.scans(); begin += 50) {
    SampleBlock block = axis.block(begin, std::min(begin + 50, axis.scans()));
    block.quality[0][block.scans() / 2] = Quality::suspect;
    ASSERT_TRUE(pipeline.push(block));
  }
  const auto run = pipeline.finish();
  ASSERT_TRUE(run);
  EXPECT_EQ(run->points.size(), measured(axis, axis.scans(), 50)->points.size());
  EXPECT_EQ(notices(*run).find("stops_not_placed"), std::string::npos) << notices(*run);
}

// When the run begins, the encoder has no position yet. The positions beyond the five targets,
// where the axis is parked and turns, are no targets.
TEST(Datum, AFirstScanWithoutPositionFailsNoRun) {
  const LostCountAxis axis(99);
  const Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  for (const std::size_t without : {std::size_t{1}, axis.scans()}) {
    Pipeline pipeline = Pipeline::create(rig, {}).value();
    SampleBlock block = axis.block(0, axis.scans());
    std::fill_n(block.value[0].begin(), without, kNaN);
    std::fill_n(block.quality[0].begin(), without, Quality::missing);
    ASSERT_TRUE(pipeline.push(block));
    const auto run = pipeline.finish();
    if (without == 1) {
      ASSERT_TRUE(run) << run.error().message;
      EXPECT_EQ(run->points.size(), 10u);
    } else {
      ASSERT_FALSE(run);
      EXPECT_NE(run.error().message.find("has an encoder position"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace mdof::daemon
