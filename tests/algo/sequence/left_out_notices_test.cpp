// Notices about stops that are left out. They state the number of stops and the first five
// positions of each reason. Mutation tests (tests/mutate) found these cases.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "algo/sequence/sequence.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

// The log begins at 10.02 mm with an unknown approach, and the axis returns from 9 mm. The targets
// are at 10, 20 and 30 mm.
Sequence sequence_of(const std::vector<double>& stops_mm) {
  std::vector<Point> points;
  double before_mm = 9;
  for (const double at_mm : stops_mm) {
    Point p;
    p.begin_ns = static_cast<std::int64_t>(points.size()) * 7 + 3;
    p.position_m = 1e-3 * at_mm;
    p.direction = points.empty() ? 0 : at_mm > before_mm ? 1 : -1;
    p.travel_min_m = 1e-3 * before_mm;
    p.travel_max_m = 1e-3 * at_mm;
    points.push_back(p);
    before_mm = points.size() == 1 ? 9 : at_mm;
  }
  SequenceOptions options;
  options.targets_m = {10e-3, 20e-3, 30e-3};
  return recognise_sequence(points, options);
}

// The window of a target is 0.25 mm: 20.24 and 29.76 mm are at targets, 20.26 and 29.74 mm are not.
TEST(LeftOutNotice, ListsTheFirstFivePositionsOfEachReason) {
  const Sequence s =
      sequence_of({10.02, 10.01, 13.1, 14.2346, 20.24, 20.26, 23.3, 29.74, 29.76, 33.7});
  EXPECT_EQ(test::shown(s.notices),
            "stop_near_no_target stops=6 positions_mm=13.1000, 14.2346, 20.2600, 23.3000, 29.7400, "
            "...\nstop_parked_at_start stops=1 positions_mm=10.0200\n");
  ASSERT_EQ(s.left_out.size(), 7u);
  EXPECT_NEAR(s.left_out[1].position_m, 14.2346e-3, 1e-12);
  EXPECT_EQ(s.left_out[1].begin_ns, 24);  // fourth stop
  EXPECT_EQ(s.left_out[1].reason, "stop_near_no_target");
  EXPECT_EQ(s.points.size(), 3u);
}

TEST(LeftOutNotice, ListsAllOfFivePositions) {
  const Sequence s = sequence_of({10.02, 10.01, 13.1, 14.2, 20.1, 23.3, 29.9, 33.7, 34.8});
  EXPECT_EQ(test::shown(s.notices),
            "stop_near_no_target stops=5 positions_mm=13.1000, 14.2000, 23.3000, 33.7000, 34.8000\n"
            "stop_parked_at_start stops=1 positions_mm=10.0200\n");
}

}  // namespace
}  // namespace mdof::algo
