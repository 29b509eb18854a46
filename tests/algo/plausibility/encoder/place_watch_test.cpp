// Positions that an axis with a speed of at most 100 m/s can or cannot have reached.
#include "algo/plausibility/encoder/place_watch.h"

#include <gtest/gtest.h>

#include <vector>

#include "algo/points/frame_rows.h"
#include "schema/sample.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

constexpr std::int64_t kMs = 1'000'000;

struct TimedPlace {
  std::int64_t ms;
  double at_m;
};

FrameBlock frames_at(const std::vector<TimedPlace>& places) {
  FrameBlock frames = empty_frames(0);
  for (const auto& [ms, at_m] : places) {
    frames.time_ns.push_back(ms * kMs);
    frames.encoder_m.push_back(at_m);
  }
  return frames;
}

// One character for each frame: '+' if the frame has a valid position, '-' if it has none. The axis
// is at 0 m at 0 ms.
std::string placed(PlaceWatch& watch, const std::vector<TimedPlace>& places) {
  const FrameBlock frames = frames_at(places);
  std::string text;
  for (std::size_t from = 0; from < frames.size();) {
    const std::size_t to = watch.find_placed_end(frames, from);
    text.append(to - from, '+');
    from = watch.find_unplaced_end(frames, to);
    text.append(from - to, '-');
  }
  return text;
}
std::string placed(const std::vector<TimedPlace>& places) {
  PlaceWatch watch(100);
  watch.begin_at(0, 0);
  return placed(watch, places);
}

// The reach is 0.1 m per millisecond, plus 50 um for noise.
TEST(PlaceWatch, ReachIsSpeedTimesTime) {
  EXPECT_EQ(placed({{1, 0.10004}}), "+");
  EXPECT_EQ(placed({{1, 0.10006}}), "-");
  EXPECT_EQ(placed({{1, -0.10004}}), "+");
  EXPECT_EQ(placed({{1, -0.10006}}), "-");
  EXPECT_EQ(placed({{1, 0.1}, {2, 0.2}, {3, 0.1}, {5, -0.1}, {6, 0.2}}), "++++-");
  EXPECT_EQ(placed({{1, kNaN}, {2, 0.2}, {3, kNaN}}), "-+-");
}

// Positions that continue from an invalid position are also invalid, even if the axis could have
// reached them in the time.
TEST(PlaceWatch, PositionsAfterAStrayPositionAreStray) {
  EXPECT_EQ(placed({{1, 1}, {5, 1}, {20, 1.001}}), "---");
  // The count returns to a position that the axis can have reached. It is 0.7 m from the invalid
  // position, 3 ms later.
  EXPECT_EQ(placed({{1, 1}, {4, 0.3}, {5, 0.35}}), "-++");
  // 0.5 m from the valid position (4 ms) and from the invalid one (3 ms).
  EXPECT_EQ(placed({{1, 1}, {4, 0.5}}), "--");
  // If a position is ten times nearer to the last valid position than to the invalid position, it
  // is valid after any time.
  EXPECT_EQ(placed({{1, 1}, {40, 0.09}}), "-+");
  EXPECT_EQ(placed({{1, 1}, {40, 0.095}}), "--");
  EXPECT_EQ(placed({{1, 1}, {40, -0.1}}), "-+");
  EXPECT_EQ(placed({{1, 1}, {40, -0.12}}), "--");
}

TEST(PlaceWatch, LeavesOutOnlyMissingPositionsBeforeItBegins) {
  PlaceWatch watch(100);
  EXPECT_EQ(placed(watch, {{1, 0}, {2, 50}, {3, kNaN}, {4, -50}}), "++-+");
  EXPECT_EQ(watch.left_out(), 1u);
  // After begin_at(), positions that the axis cannot have reached are left out, too.
  watch.begin_at(4 * kMs, -50);
  EXPECT_EQ(placed(watch, {{5, -49.9}, {6, 0}}), "+-");
}

TEST(PlaceWatch, ReportsNumberAndFirstScan) {
  PlaceWatch watch(100);
  watch.begin_at(0, 0);
  EXPECT_TRUE(watch.notices(0).empty());
  EXPECT_EQ(placed(watch, {{1000, 0.5}, {1001, kNaN}, {1002, 2.5}, {1003, 2.5}, {1004, kNaN}}),
            "+----");
  EXPECT_EQ(watch.left_out(), 4u);
  EXPECT_EQ(test::shown(watch.notices(500 * kMs)),
            "position_missing scans=2 first_s=0.501\n"
            "position_unreachable scans=2 jump_mm=2000 position_mm=500 first_s=0.502 "
            "max_speed_mm_s=100000 is_lost=1\n");
  EXPECT_EQ(placed(watch, {{1005, 0.5}}), "+");
  EXPECT_NE(test::shown(watch.notices(500 * kMs)).find("is_lost=0"), std::string::npos);
}

TEST(PlaceWatch, ReportsASingleScan) {
  PlaceWatch missing(100), stray(100);
  missing.begin_at(0, 0);
  EXPECT_EQ(placed(missing, {{1, 0.001}, {2, kNaN}, {3, 0.002}}), "+-+");
  EXPECT_EQ(test::shown(missing.notices(0)), "position_missing scans=1 first_s=0.002\n");
  stray.begin_at(0, 0);
  EXPECT_EQ(placed(stray, {{1, 0.001}, {2, 5.001}, {3, 0.002}}), "+-+");
  EXPECT_EQ(test::shown(stray.notices(0)),
            "position_unreachable scans=1 jump_mm=5000 position_mm=1 first_s=0.002 "
            "max_speed_mm_s=100000 is_lost=0\n");
}

}  // namespace
}  // namespace mdof::algo
