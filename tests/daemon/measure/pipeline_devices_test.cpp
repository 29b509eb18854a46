// Probes on two devices, the encoder on the first. Each device has its own scans and faults.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "algo/points/flags.h"
#include "tests/daemon/measure/test_axis.h"

namespace mdof::daemon {
namespace {

const std::vector<std::string> kTop = {kEncoderChannel, "A", "B", "C"}, kSide = {"D", "E"};

// `side_falls_silent`: from this scan on, the second device delivers nothing.
class TwoDevices {
 public:
  explicit TwoDevices(std::size_t side_falls_silent = SIZE_MAX) : silent_(side_falls_silent) {
    axis_.pass_both_ways({0, 5, 10, 15, 20});
    axis_.pass_both_ways({0, 5, 10, 15, 20});
  }
  // Feeds the samples of 50 ms. Returns false if there are no more samples.
  bool feed(Pipeline& pipeline) {
    const std::size_t begin = at_;
    at_ += 50;
    SampleBlock top = axis_.block(begin, at_, kTop, "t7");
    EXPECT_TRUE(pipeline.push(top));
    if (begin < silent_) {
      SampleBlock side = axis_.block(begin, at_, kSide, "capa");
      // The second device samples 0.3 ms later.
      for (auto& time_ns : side.time_ns) time_ns += 300'000;
      EXPECT_TRUE(pipeline.push(side));
    }
    return at_ < axis_.scans();
  }
  std::size_t at() const { return at_; }

 private:
  TestAxis axis_;
  std::size_t silent_, at_ = 0;
};

TEST(PipelineOfTwoDevices, TwoDevicesGiveTheSamePointsAsOneDevice) {
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  TwoDevices devices;
  while (devices.feed(pipeline)) continue;
  const auto run = pipeline.finish();
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 20u);
  for (const auto& p : run->points) expect_true_errors(p, 1e3 * p.target_m);
  EXPECT_EQ(run->points.back().run, 2);
}

TEST(PipelineOfTwoDevices, ReportsASilentDeviceAndContinuesAfterAWhile) {
  constexpr std::size_t kSilent = 3000;  // 3000 scans are 3 s; the axis is then at its sixth stop
  Pipeline pipeline = Pipeline::create(five_probe_rig(), {}).value();
  TwoDevices devices(kSilent);
  while (devices.feed(pipeline) && devices.at() < kSilent + 1000) continue;
  const auto waits = pipeline.waiting_for();
  ASSERT_TRUE(waits);
  EXPECT_TRUE(*waits == "D" || *waits == "E") << *waits;
  const std::size_t points_before_lag = pipeline.points().size();
  while (devices.feed(pipeline)) continue;
  EXPECT_GT(pipeline.points().size(), points_before_lag + 5)
      << "after the lag bound points come again";
  const auto run = pipeline.finish();
  ASSERT_TRUE(run) << run.error().message;
  ASSERT_EQ(run->points.size(), 20u);
  for (const auto& p : run->points) {
    const bool before = p.point.end_ns < TestAxis::time_ns(kSilent);
    EXPECT_EQ(p.errors.valid, before || p.point.begin_ns < TestAxis::time_ns(kSilent));
    if (before) expect_true_errors(p, 1e3 * p.target_m);
    if (p.point.begin_ns < TestAxis::time_ns(kSilent)) continue;
    EXPECT_TRUE(algo::has_flag(p.point, Flag::lost, "D") &&
                algo::has_flag(p.point, Flag::lost, "E"));
    EXPECT_NE(p.errors.reason.find("probes A B C cannot"), std::string::npos) << p.errors.reason;
    EXPECT_TRUE(std::isnan(p.point.probe_m[3]) && !std::isnan(p.point.probe_m[0]));
  }
}

// In a live run, blocks of the two devices alternate every few scans. In the recording, a block
// has the samples of 0.1 s. The samples of the second device arrive late and in batches. After
// scan 700, in the second stop, every 37th scan of the second device is lost.
TEST(PipelineOfTwoDevices, TheOrderOfBlocksChangesNoBit) {
  TestAxis axis;
  axis.pass_both_ways({0, 5, 10, 15, 20});
  const auto late_side = [&](std::size_t begin, std::size_t end) {
    const SampleBlock all = axis.block(begin, end, kSide, "capa");
    SampleBlock side = axis.block(0, 0, kSide, "capa");
    for (std::size_t i = 0; i < all.scans(); ++i) {
      if (begin + i > 700 && (begin + i) % 37 == 0) continue;
      side.time_ns.push_back(all.time_ns[i]);
      for (std::size_t c = 0; c < kSide.size(); ++c)
        side.value[c].push_back(0.05 * std::round(all.value[c][i] / 0.05));
    }
    return side;
  };
  const auto measured = [&](std::size_t top_scans, std::size_t side_scans) {
    PipelineOptions options;
    options.align.delay_s = {{"D", 2e-3}, {"E", 3e-3}};
    Pipeline pipeline = Pipeline::create(five_probe_rig(), options).value();
    std::size_t side_at = 0;
    for (std::size_t at = 0; at < axis.scans(); at += top_scans) {
      SampleBlock top = axis.block(at, at + top_scans, kTop, "t7");
      EXPECT_TRUE(pipeline.push(top));
      for (; side_at < std::min(axis.scans(), at + top_scans); side_at += side_scans) {
        SampleBlock side = late_side(side_at, side_at + side_scans);
        EXPECT_TRUE(pipeline.push(side));
      }
    }
    return pipeline.finish().value();
  };
  const mdof::Run live = measured(4, 10);
  ASSERT_EQ(live.points.size(), 10u);
  for (const auto& [top, side] : {std::pair{1000u, 1000u}, {1u, 400u}, {1000u, 3u}}) {
    const mdof::Run replayed = measured(top, side);
    ASSERT_EQ(replayed.points.size(), live.points.size());
    EXPECT_EQ(replayed.header.notices, live.header.notices);
    for (std::size_t i = 0; i < live.points.size(); ++i) {
      EXPECT_EQ(replayed.points[i].point.probe_m, live.points[i].point.probe_m);
      EXPECT_EQ(replayed.points[i].point.probe_u_m, live.points[i].point.probe_u_m) << i;
      EXPECT_EQ(replayed.points[i].errors.local, live.points[i].errors.local);
      EXPECT_EQ(replayed.points[i].errors.covariance, live.points[i].errors.covariance);
    }
  }
}

TEST(PipelineOfTwoDevices, ASilentEncoderUsesNoMemory) {
  PipelineOptions options;
  Pipeline pipeline = Pipeline::create(five_probe_rig(), options).value();
  TestAxis axis;
  axis.pass_both_ways({0, 5, 10, 15, 20});
  SampleBlock all = axis.block(0, axis.scans(), kTop, "t7"),
              side = axis.block(0, axis.scans(), kSide, "capa");
  ASSERT_TRUE(pipeline.push(all));
  ASSERT_TRUE(pipeline.push(side));
  // The second device alone delivers samples for about an hour. Without the encoder, these samples
  // cannot be used.
  SampleBlock more = side;
  for (std::int64_t k = 0; k < 600; ++k) {
    more = axis.block(0, axis.scans(), kSide, "capa");
    for (auto& time_ns : more.time_ns)
      time_ns += (k + 2) * static_cast<std::int64_t>(axis.scans()) * TestAxis::kPeriod_ns;
    ASSERT_TRUE(pipeline.push(more));
  }
  const auto run = pipeline.finish();
  ASSERT_TRUE(run) << run.error().message;
  EXPECT_EQ(run->points.size(), 10u);
}

}  // namespace
}  // namespace mdof::daemon
