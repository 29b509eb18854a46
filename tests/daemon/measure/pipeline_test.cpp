// The pipeline from samples to points. Each point has the errors at its position, or a reason why
// it has no errors.
#include "daemon/measure/pipeline.h"

#include <gtest/gtest.h>

#include "algo/points/flags.h"
#include "tests/daemon/measure/test_axis.h"
#include "tests/shown.h"

namespace mdof::daemon {
namespace {

const std::vector<double> kStops_mm = {0, 5, 10, 15, 20};

TestAxis both_ways(double travel = 1) {
  TestAxis axis(-1, travel);
  axis.pass_both_ways(kStops_mm);
  return axis;
}

Pipeline pipeline_of(const Rig& rig = five_probe_rig(), const PipelineOptions& options = {}) {
  return Pipeline::create(rig, options).value();
}

// Changes the samples of `axis` with `spoil`, then measures a run from them.
Result<Run> measured(const TestAxis& axis, const Rig& rig, const PipelineOptions& options,
                     const std::function<void(SampleBlock&)>& spoil = {}) {
  Pipeline pipeline = pipeline_of(rig, options);
  SampleBlock block = axis.whole();
  if (spoil) spoil(block);
  MDOF_CHECK(pipeline.push(block));
  return pipeline.finish();
}

Result<Run> measured(const TestAxis& axis, const std::function<void(SampleBlock&)>& spoil = {}) {
  return measured(axis, five_probe_rig(), {}, spoil);
}

// kWay, kStand: scans of a movement and of a stop in both_ways(). kC: index of channel C in a
// block.
constexpr std::size_t kWay = 100, kStand = 400, kC = 3;
std::size_t stop_begin_scan(std::size_t stop) {
  return kWay + stop * (kWay + kStand) + (stop >= kStops_mm.size() ? kWay : 0);
}
void lose(SampleBlock& block, std::size_t c, std::size_t begin, std::size_t end) {
  block.quality.resize(block.channels.size());
  block.quality[c].resize(block.scans(), Quality::good);
  for (std::size_t i = begin; i < end; ++i) {
    block.value[c][i] = kNaN;
    block.quality[c][i] = Quality::missing;
  }
}

std::string all_notices(const Run& run) {
  return test::shown(run.header.notices);
}

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

TEST(Pipeline, EveryStopHasTheErrorsOfItsPosition) {
  const auto run = measured(both_ways());
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const MeasuredPoint& p = run->points[i];
    const std::size_t target = i < 5 ? i : 9 - i;
    EXPECT_EQ(p.target, static_cast<int>(target) + 1);
    EXPECT_EQ(p.run, 1);
    EXPECT_EQ(p.point.direction, i < 5 ? 1 : -1);
    EXPECT_NEAR(p.point.position_m, 1e-3 * kStops_mm[target], 1e-12);
    expect_true_errors(p, kStops_mm[target]);
    EXPECT_TRUE(p.point.flags.empty()) << to_string(p.point.flags);
  }
  EXPECT_EQ(run->header.axis, Axis::x);
  EXPECT_EQ(run->header.state, RunState::complete);
  EXPECT_EQ(run->header.stated.reference, Reference::fixture);
  EXPECT_EQ(run->header.scans, both_ways().scans());
  EXPECT_EQ(run->header.scans_lost, 0u);
  EXPECT_FALSE(run->header.temperature);
  EXPECT_FALSE(run->straightness.empty());
  EXPECT_FALSE(run->angles.empty());
  EXPECT_TRUE(run->plausibility);
}

TEST(Pipeline, AnAxisThatNeverStopsIsNotComplete) {
  TestAxis moving, stepping;
  for (int pass = 0; pass < 2; ++pass) {
    moving.move_to(60, 3), moving.stand(0.3), moving.move_to(0, 3), moving.stand(0.3);
    stepping.stop_at(60), stepping.stop_at(0);
  }
  const auto never = measured(moving);
  ASSERT_TRUE(never) << never.error().message;
  EXPECT_EQ(never->header.state, RunState::partial);
  EXPECT_SAYS(all_notices(*never), "axis_never_stops moving_percent=");
  EXPECT_SAYS(all_notices(*never), " stops_mm=0 and 60\n");
  const auto between_two = measured(stepping);
  ASSERT_TRUE(between_two) << between_two.error().message;
  EXPECT_EQ(between_two->header.state, RunState::complete) << all_notices(*between_two);
}

// First case: the table moves, and it moves in the - direction of M as the encoder increases.
// Second case: the fixture moves in the + direction. In both cases the travel of the target is
// minus the position of the encoder.
TEST(Pipeline, TravelFollowsFromMovingBodyAndDirection) {
  for (const Sides sides : {Sides{false, true}, Sides{true, false}}) {
    Rig rig = five_probe_rig();
    rig.sides = sides;
    const auto run = measured(both_ways(-1), rig, {});
    ASSERT_TRUE(run) << run.error().message;
    ASSERT_EQ(run->points.size(), 10u);
    for (const auto& p : run->points) expect_true_errors(p, -1e3 * p.point.position_m);
    EXPECT_EQ(run->header.sides, sides);
  }
}

TEST(Pipeline, TheDivisionIntoBlocksChangesNoBit) {
  const TestAxis axis = both_ways();
  const mdof::Run whole = measured(axis).value();
  for (const std::size_t per_block : {1u, 7u, 500u}) {
    Pipeline pipeline = pipeline_of();
    for (std::size_t i = 0; i < axis.scans(); i += per_block) {
      SampleBlock block = axis.block(i, i + per_block);
      ASSERT_TRUE(pipeline.push(block));
      // Points are read after each block, or only at the end.
      if (per_block == 500) pipeline.points();
    }
    const auto run = pipeline.finish();
    ASSERT_EQ(run->points.size(), whole.points.size());
    for (std::size_t i = 0; i < whole.points.size(); ++i) {
      EXPECT_EQ(run->points[i].errors.local, whole.points[i].errors.local);
      EXPECT_EQ(run->points[i].errors.covariance, whole.points[i].errors.covariance);
    }
  }
}

TEST(Pipeline, AProbeMissingAtOneStopLosesOnlyThatPoint) {
  const auto run = measured(both_ways(), [](SampleBlock& block) {
    lose(block, kC, stop_begin_scan(2), stop_begin_scan(2) + kStand);
  });
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i) {
    const auto& p = run->points[i];
    EXPECT_EQ(p.errors.valid, i != 2) << i;
    if (i != 2) expect_true_errors(p, 1e3 * p.target_m);
  }
  const auto& lost = run->points[2];
  EXPECT_SAYS(lost.errors.reason, "probes A B D E cannot separate");
  EXPECT_TRUE(std::isnan(lost.point.probe_m[2]));
  EXPECT_FALSE(std::isnan(lost.point.probe_m[1]));
  EXPECT_TRUE(algo::has_flag(lost.point, Flag::lost, "C")) << lost.point.flags.size();
}

// Probe C vibrates with an amplitude of 0.9 um about 99 um, and its range ends at 100 um. Each
// tenth reading is beyond the range. The mean of the readings within the range would therefore be
// wrong.
TEST(Pipeline, AProbeAtTheEndOfItsRangeGivesNoReading) {
  const auto run = measured(both_ways(), [](SampleBlock& block) {
    for (std::size_t i = 0; i < kStand; ++i)
      block.value[kC][stop_begin_scan(2) + i] =
          i % 10 == 0 ? 100.5 : 99 + 0.9 * (static_cast<double>(i % 3) - 1);
  });
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 10u);
  EXPECT_TRUE(std::isnan(run->points[2].point.probe_m[2]));
  EXPECT_FALSE(run->points[2].errors.valid);
  EXPECT_SAYS(run->points[2].errors.reason, "probe C is at the end of its range");
  EXPECT_SAYS(all_notices(*run), "probe_beyond_range C points=1 of=10 range_um=200\n");
}

TEST(Pipeline, AFewMissingReadingsOfAStopLoseNoPoint) {
  const auto run = measured(both_ways(), [](SampleBlock& block) {
    lose(block, kC, stop_begin_scan(2) + 200, stop_begin_scan(2) + 220);
  });
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 10u);
  expect_true_errors(run->points[2], 10);
}

TEST(Pipeline, AProbeThatIsAlwaysDeadIsTheReasonOfTheFailure) {
  const auto refusal = [](const std::function<void(SampleBlock&)>& spoil) {
    const auto run = measured(both_ways(), spoil);
    return run ? "measured" : run.error().message;
  };
  const std::string missing = refusal([](SampleBlock& b) { lose(b, kC, 0, b.scans()); });
  EXPECT_SAYS(missing, "probe \"C\" gave no usable value at any stop");
  const std::string frozen =
      refusal([](SampleBlock& b) { std::fill(b.value[kC].begin(), b.value[kC].end(), 1.25); });
  EXPECT_SAYS(frozen, "probe \"C\" gives the same reading in every scan");
  const std::string saturated = refusal([](SampleBlock& b) {
    for (double& um : b.value[kC]) um += 150;
  });
  EXPECT_SAYS(saturated, "the reading of probe \"C\" is beyond its range (200 um) in every stop");
  EXPECT_SAYS(saturated, "range_um");
}

// Five probes are sufficient. If the sixth probe fails, the run is measured and has a notice.
TEST(Pipeline, ADeadProbeThatIsNotNeededGivesANotice) {
  Rig rig = five_probe_rig();
  Probe more = rig.probes[0];
  more.id = "F";
  more.position_m[0] = -10e-3;
  rig.probes.push_back(more);
  const auto run = measured(both_ways(), rig, {}, [](SampleBlock& block) {
    block.channels.push_back({"F", Unit::um});
    block.value.emplace_back(block.scans(), kNaN);
    block.quality.assign(7, {});
    block.quality[6].assign(block.scans(), Quality::missing);
  });
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_SAYS(all_notices(*run), "probe_dead F");
  ASSERT_EQ(run->points.size(), 10u);
  for (const auto& p : run->points) expect_true_errors(p, 1e3 * p.target_m);
}

TEST(Pipeline, ReportsWhyNothingWasMeasured) {
  const auto refusal = [](const TestAxis& axis, const PipelineOptions& options = {}) {
    const auto run = measured(axis, five_probe_rig(), options);
    return run ? "measured" : run.error().message;
  };
  EXPECT_SAYS(refusal(TestAxis()), "no samples arrived from the rig's probes and the encoder");
  TestAxis parked(12.5);
  parked.stand(3);
  EXPECT_SAYS(refusal(parked), "the encoder stays at 12.5 mm (within 0 um)");
  TestAxis passing;
  for (const double mm : {20.0, 0.0}) passing.move_to(mm, 2);
  EXPECT_SAYS(refusal(passing), "no stop found in 4000 scans from -0.9895 to 19.99 mm");
  // 1 kHz and 100 Hz in minutes.
  struct Case {
    std::int64_t parts;
    const char* rate;
  };
  for (const Case& of : {Case{60, "59999"}, Case{6, "6000"}}) {
    const auto in_minutes = measured(both_ways(), five_probe_rig(), {}, [&](SampleBlock& block) {
      for (std::int64_t& t_ns : block.time_ns) t_ns /= of.parts;
    });
    ASSERT_FALSE(in_minutes);
    EXPECT_SAYS(in_minutes.error().message, "the sample rate is " + std::string(of.rate) +
                                                " Hz: if time_s of the log is in minutes or hours");
  }
  PipelineOptions elsewhere;
  elsewhere.sequence.targets_m = {0.1, 0.2};
  EXPECT_SAYS(refusal(both_ways(), elsewhere), "none of the 10 stops is near a given target");
}

TEST(Pipeline, AnUnfinishedStopIsAPointWhenTheRunEnds) {
  TestAxis axis;
  for (const double mm : {0.0, 5.0}) axis.stop_at(mm);
  axis.stand(60);
  PipelineOptions options;
  options.dwell.max_scans = 5'000;
  Pipeline pipeline = pipeline_of(five_probe_rig(), options);
  for (std::size_t i = 0; i < axis.scans(); i += 1000) {
    SampleBlock block = axis.block(i, i + 1000);
    ASSERT_TRUE(pipeline.push(block));
    ASSERT_LE(pipeline.points().size(), 1u) << "a stop that goes on is no point yet";
  }
  EXPECT_TRUE(pipeline.still());
  const auto run = pipeline.finish();
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 2u);
  expect_true_errors(run->points[1], 5);
  EXPECT_TRUE(algo::has_flag(run->points[1].point, Flag::truncated));
  EXPECT_LE(run->points[1].point.samples, 5'000u);
  EXPECT_EQ(run->header.scans, axis.scans());
}

TEST(Pipeline, TheRequestDecidesWhetherARunIsComplete) {
  PipelineOptions options;
  for (const double mm : kStops_mm) options.sequence.targets_m.push_back(1e-3 * mm);
  options.repeats = 1;
  EXPECT_EQ(measured(both_ways(), five_probe_rig(), options)->header.state, RunState::complete);
  options.repeats = 2;
  const auto run = measured(both_ways(), five_probe_rig(), options);
  EXPECT_EQ(run->header.state, RunState::partial);
  EXPECT_SAYS(all_notices(*run), "points_missing missing=10 of=20 ");
}

TEST(Pipeline, TheTemperatureIsTheMeanOfItsReadings) {
  const auto run = measured(both_ways(), [](SampleBlock& block) {
    block.channels.push_back({"temperature", Unit::deg_c});
    block.value.emplace_back(block.scans(), kNaN);
    for (std::size_t i = 0; i < 4; ++i) block.value.back()[i] = std::array{20.5, 19.5, 21., 20.}[i];
  });
  ASSERT_TRUE(run && run->header.temperature);
  EXPECT_DOUBLE_EQ(run->header.temperature->mean_C, 20.25);
  EXPECT_EQ(run->header.temperature->min_C, 19.5);
  EXPECT_EQ(run->header.temperature->max_C, 21);
}

TEST(Pipeline, LostScansAreCountedAndTheApproachIsAssumed) {
  const TestAxis axis = both_ways();
  Pipeline pipeline = pipeline_of();
  // Before the movement to stop 7; the lost scans include this movement and 50 scans of the stop.
  const std::size_t unseen = stop_begin_scan(7) - kWay;
  SampleBlock before = axis.block(0, unseen), after = axis.block(unseen + kWay + 50, axis.scans());
  after.lost = kWay + 50;
  ASSERT_TRUE(pipeline.push(before));
  ASSERT_TRUE(pipeline.push(after));
  const auto run = pipeline.finish();
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->header.scans_lost, kWay + 50);
  ASSERT_EQ(run->points.size(), 10u);
  for (std::size_t i = 0; i < 10; ++i)
    EXPECT_EQ(algo::has_flag(run->points[i].point, Flag::approach_assumed), i == 7) << i;
}

TEST(Pipeline, TheLiveViewShowsTheNewestScanAndKeepsNoPoints) {
  PipelineOptions options;
  options.keep_points = false;
  Pipeline view = pipeline_of(five_probe_rig(), options);
  EXPECT_EQ(view.newest().size(), 0u);
  const TestAxis axis = both_ways();
  const std::size_t shown = stop_begin_scan(3) + 300;
  SampleBlock block = axis.block(0, shown);
  ASSERT_TRUE(view.push(block));
  const FrameBlock& newest = view.newest();
  ASSERT_EQ(newest.size(), 1u);
  EXPECT_EQ(newest.time_ns[0], TestAxis::time_ns(shown - 1));
  EXPECT_NEAR(newest.encoder_m[0], 15e-3, 1e-15);
  std::vector<double> readings_m;
  for (const auto& probe : newest.probe_m) readings_m.push_back(probe[0]);
  EXPECT_NEAR(readings_m[3], 1e-6 * TrueErrors::at(15).readings_um(15)[3], 4e-9);
  const AxisErrors errors = view.solve_at(15e-3, readings_m, std::vector<double>(5, 1e-9));
  ASSERT_TRUE(errors.valid);
  EXPECT_NEAR(errors.local[0], TrueErrors::at(15).at_fixture(15)[0], 1e-7);
  EXPECT_NEAR(errors.local[4], TrueErrors::at(15).at_fixture(15)[4], 1e-6);
  EXPECT_TRUE(view.still());
  EXPECT_TRUE(view.points().empty());
}

TEST(Pipeline, RejectsDecreasingTimeWithTheDevice) {
  Pipeline pipeline = pipeline_of();
  const TestAxis axis = both_ways();
  SampleBlock late = axis.block(500, 600), early = axis.block(100, 200);
  ASSERT_TRUE(pipeline.push(late));
  const Status pushed = pipeline.push(early);
  ASSERT_FALSE(pushed);
  EXPECT_SAYS(pushed.error().message, "device \"daq\": the time stamp ");
}

TEST(Pipeline, RejectsARigThatCannotDetermineAnError) {
  Rig rig = five_probe_rig();
  rig.probes[4].position_m[0] =
      rig.probes[3].position_m[0];  // E is at the same x as D, so yaw cannot be determined
  rig.probes[4].position_m[2] = 0;
  const auto pipeline = Pipeline::create(rig, {});
  ASSERT_FALSE(pipeline);
  EXPECT_SAYS(pipeline.error().message, "ECX");
}

TEST(Pipeline, LimitsTheStopsAndReportsTheOmittedOnes) {
  PipelineOptions options;
  options.max_stops = 7;
  Pipeline pipeline = pipeline_of(five_probe_rig(), options);
  SampleBlock block = both_ways().whole();
  ASSERT_TRUE(pipeline.push(block));
  EXPECT_TRUE(pipeline.is_full());
  EXPECT_EQ(pipeline.points().size(), 7u);
  const auto run = pipeline.finish();
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->points.size(), 7u);
  EXPECT_SAYS(all_notices(*run), "stops_over_limit stops=7 left_out=3");
  const auto whole = measured(both_ways());
  for (std::size_t i = 0; i < 7; ++i)
    EXPECT_EQ(run->points[i].point.probe_m, whole->points[i].point.probe_m);
}

}  // namespace
}  // namespace mdof::daemon
