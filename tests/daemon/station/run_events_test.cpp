#include "daemon/station/run_events.h"

#include <gtest/gtest.h>
#include <simdjson.h>

#include "tests/algo/rigs.h"

namespace mdof::daemon {
namespace {

// A resumed long run has many points. One message cannot contain all of them, and none may be
// lost.
TEST(RunEvents, ManyPointsAreDividedIntoMessages) {
  std::vector<MeasuredPoint> points(500);
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].target = static_cast<int>(i) + 1;
    points[i].errors.valid = true;
    for (double& x : points[i].errors.local) x = 1.23456789012345e-6;
    for (double& x : points[i].errors.covariance) x = 1.23456789012345e-14;
  }
  points.insert(points.begin(), 40, points.front());  // these points were already sent
  const auto messages = points_messages(7, test::rig_x(), Model::exact, points, 40);
  EXPECT_GT(messages.size(), 1u);
  std::uint64_t next = 40;
  simdjson::dom::parser parser;
  for (const auto& message : messages) {
    EXPECT_LT(message.size(), 48u * 1024 - 128);
    const auto json = parser.parse(message);
    EXPECT_EQ(std::uint64_t(json["offset"]), next);
    EXPECT_EQ(std::string_view(json["u_covers"]),
              "noise only (no uncertainties are declared); repeatability is not included (u is "
              "given for each single stop)");
    for (const auto point : json["points"]) EXPECT_EQ(std::uint64_t(point["target"]), ++next - 40);
  }
  EXPECT_EQ(next, 540u);
}

TEST(RunEvents, NoPointsGiveNoMessage) {
  const Rig rig = test::rig_x();
  EXPECT_TRUE(points_messages(7, rig, Model::exact, {}, 0).empty());
  EXPECT_TRUE(points_messages(7, rig, Model::exact, {MeasuredPoint{}}, 1).empty());
}

}  // namespace
}  // namespace mdof::daemon
