// Tests which events are reported by a notice, and how many. Mutation tests (tests/mutate) found
// these cases.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

#include "algo/plausibility/slow_stretch.h"
#include "algo/points/dwell_event.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

using test::shown;

constexpr std::int64_t kSecond_ns = 1'000'000'000;

// Two stops: at 0 mm from 10 s to 11 s, and at 10 mm from 20 s to 21 s.
std::vector<Point> two_points() {
  std::vector<Point> points(2);
  points[0].position_m = 0, points[1].position_m = 10e-3;
  points[0].begin_ns = 10 * kSecond_ns, points[0].end_ns = 11 * kSecond_ns;
  points[1].begin_ns = 20 * kSecond_ns, points[1].end_ns = 21 * kSecond_ns;
  return points;
}

bool is_reported_event(DwellEventKind kind, double position_mm, double time_s,
                       double length_s = 0.5) {
  const DwellEvent n{kind, static_cast<std::int64_t>(time_s * 1e9), 1e-3 * position_mm, 0,
                     length_s};
  const auto found = event_notices({n}, two_points(), 0, 0.2);
  EXPECT_LE(found.size(), 1u);
  return !found.empty();
}

// If a short stop is directly before or after a point at its position, it is not reported.
TEST(EventNotices, ShortStopBesideItsPointIsNotReported) {
  for (const DwellEventKind kind : {DwellEventKind::short_stop, DwellEventKind::creep}) {
    EXPECT_TRUE(is_reported_event(kind, 5, 15));
    EXPECT_FALSE(is_reported_event(kind, 9.99, 18.6));
    EXPECT_TRUE(is_reported_event(kind, 9.99, 18.4));
    EXPECT_FALSE(is_reported_event(kind, 9.99, 21.9));
    EXPECT_TRUE(is_reported_event(kind, 9.99, 22.1));
    EXPECT_TRUE(is_reported_event(kind, 9.94, 20.5));
    EXPECT_FALSE(is_reported_event(kind, 9.96, 20.5));
    EXPECT_TRUE(is_reported_event(kind, 10, 10.5));  // during the time of the other point
  }
}

// Short stops beyond the end targets are turns of the axis.
TEST(EventNotices, TurnBeyondTheEndsIsNotReported) {
  EXPECT_TRUE(is_reported_event(DwellEventKind::short_stop, 10.04, 30));
  EXPECT_FALSE(is_reported_event(DwellEventKind::short_stop, 10.06, 30));
  EXPECT_TRUE(is_reported_event(DwellEventKind::short_stop, -0.04, 30));
  EXPECT_FALSE(is_reported_event(DwellEventKind::short_stop, -0.06, 30));
  const DwellEvent n{DwellEventKind::short_stop, kSecond_ns, 50e-3, 0, 0.1};
  EXPECT_EQ(event_notices({n}, {}, 0, 0.2).size(), 1u);
}

TEST(EventNotices, EventsOfPositionsAreAlwaysReported) {
  for (const DwellEventKind kind :
       {DwellEventKind::jump, DwellEventKind::hole, DwellEventKind::crept}) {
    EXPECT_TRUE(is_reported_event(kind, 10, 20.5));
    EXPECT_TRUE(is_reported_event(kind, 15, 30));
  }
}

// Ten notices of each kind are listed, followed by the number of the other notices. Jumps come
// first.
TEST(EventNotices, ReportsTenOfAKind) {
  std::vector<DwellEvent> events(10, {DwellEventKind::hole, kSecond_ns, 5e-3, 1e-3, 2});
  events.push_back({DwellEventKind::jump, 3 * kSecond_ns, 4e-3, -25e-6, 0});
  const auto ten = event_notices(events, two_points(), kSecond_ns, 0.2);
  ASSERT_EQ(ten.size(), 11u);
  EXPECT_EQ(shown(ten[0]), "encoder_jump jump_um=-25 position_mm=4 time_s=2");
  EXPECT_EQ(shown(ten[1]), "recording_hole length_s=2 time_s=0 position_mm=5 moved_mm=1");
  events.insert(events.end(), 2, events[0]);
  const auto twelve = event_notices(events, two_points(), kSecond_ns, 0.2);
  ASSERT_EQ(twelve.size(), 12u);
  EXPECT_EQ(shown(twelve.back()), "more_alike count=2 alike=recording_hole");
}

// The axis moves by `per_window_m` in each window of 50 ms; the tolerance is 2 um. A window is slow
// up to 50 um. The stretch of slow windows is reported at its end.
std::optional<DwellEvent> slow_stretch_event(int windows, double per_window_m, bool stood = false,
                                             double most_m = 200e-6) {
  SlowStretch stretch;
  const auto window = [&](int i, double range_m, bool still) {
    const double at_m = i * per_window_m;
    const std::int64_t begin_ns = 50'000'000LL * i;
    return stretch.take(
        {begin_ns, begin_ns + 50'000'000, at_m, at_m + per_window_m, range_m, still}, 2e-6, 0.2,
        most_m);
  };
  EXPECT_FALSE(window(0, 1e-3, false));
  for (int i = 1; i <= windows; ++i)
    EXPECT_FALSE(window(i, std::abs(per_window_m), stood && i == 2));
  auto reported = window(windows + 1, 1e-3, false);
  EXPECT_FALSE(window(windows + 2, 1e-3, false));
  return reported;
}

TEST(SlowStretchRule, IsReportedWithPositionSizeAndLength) {
  for (const double per_window_m : {10e-6, -10e-6}) {
    const auto reported = slow_stretch_event(10, per_window_m);
    ASSERT_TRUE(reported);
    EXPECT_EQ(reported->kind, DwellEventKind::creep);
    EXPECT_EQ(reported->time_ns, 50'000'000);
    EXPECT_NEAR(reported->size_m, 10 * per_window_m, 1e-12);
    EXPECT_NEAR(reported->position_m, 6 * per_window_m, 1e-12);
    EXPECT_NEAR(reported->length_s, 0.5, 1e-12);
  }
}

TEST(SlowStretchRule, RejectsShortLongAndStoppedStretches) {
  EXPECT_TRUE(slow_stretch_event(4, 10e-6));
  EXPECT_FALSE(slow_stretch_event(3, 10e-6));  // 0.15 s
  EXPECT_TRUE(slow_stretch_event(10, 19.9e-6));
  EXPECT_FALSE(slow_stretch_event(10, 20.1e-6));
  EXPECT_FALSE(slow_stretch_event(10, -20.1e-6));
  EXPECT_FALSE(slow_stretch_event(10, 10e-6, true));
  EXPECT_TRUE(slow_stretch_event(10, 49.9e-6, false, 1));
  EXPECT_FALSE(slow_stretch_event(10, 50.1e-6, false, 1));  // above the limit of a slow window
}

}  // namespace
}  // namespace mdof::algo
