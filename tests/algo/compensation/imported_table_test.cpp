#include "algo/compensation/imported_table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

#include "schema/iso230/targets.h"

namespace mdof::algo {
namespace {

// A run with the positioning error of X at 0, 10 and 20 mm and `repeats` readings in each
// direction.
Run imported(std::int64_t id, int repeats, double declared_m = 0) {
  mdof::Run run;
  run.header.id = id;
  run.header.axis = Axis::x;
  run.header.provenance.recording_kind = "imported";
  run.header.provenance.recording_sha256 = std::to_string(id);
  run.header.provenance.model = "EXX";
  for (int j = 0; j < repeats; ++j)
    for (const int direction : {1, -1})
      for (int i = 0; i < 3; ++i) {
        MeasuredPoint& p = run.points.emplace_back();
        p.target_m = 10e-3 * i;
        p.point.direction = direction;
        p.point.probe_m = {1e-6 * (i + 0.1 * direction + 0.01 * j)};
        if (declared_m > 0) p.point.probe_u_m = {declared_m};
      }
  return run;
}

std::string refusal(const std::vector<mdof::Run>& runs) {
  const auto table = build_positioning_table(runs);
  return table ? "" : table.error().message;
}

TEST(ImportedTable, MeansAndTheirUncertaintyByHand) {
  const auto table = build_positioning_table({imported(3, 3, 0.1e-6), imported(4, 1, 0.3e-6)});
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->runs, (std::vector<std::int64_t>{3, 4}));
  EXPECT_FALSE(table->simulated);
  ASSERT_EQ(table->position_m.size(), 3U);
  const PositioningErrors& along = table->positioning;
  for (std::size_t i = 0; i < 3; ++i) {
    // The four readings exceed the first one by 0, 0.01, 0.02 and 0 µm: the mean of these
    // differences is 0.0075 µm, s = 0.009574 µm, u = s/√4.
    EXPECT_NEAR(along.forward[i], 1e-6 * (static_cast<double>(i) + 0.1075), 1e-18);
    EXPECT_NEAR(along.reverse[i], 1e-6 * (static_cast<double>(i) - 0.0925), 1e-18);
    EXPECT_NEAR(along.u_forward[i], 0.0047871e-6, 1e-12);
    EXPECT_NEAR(along.u_reverse[i], 0.0047871e-6, 1e-12);
    EXPECT_EQ(along.u_declared[i], 0.3e-6);
    EXPECT_TRUE(std::isnan(table->forward[0][i]));
  }
  EXPECT_TRUE(positioning_notices({imported(3, 3)}).empty());
}

TEST(ImportedTable, SingleReadingHasNoRepeatability) {
  mdof::Run run = imported(1, 1);
  std::erase_if(run.points, [](const MeasuredPoint& p) { return p.point.direction < 0; });
  const auto table = build_positioning_table({run});
  ASSERT_TRUE(table);
  EXPECT_TRUE(std::isnan(table->positioning.u_forward[0]));
  EXPECT_TRUE(std::isnan(table->positioning.reverse[0]));
  EXPECT_TRUE(table->positioning.u_declared.empty());
  EXPECT_EQ(positioning_notices({run}), Notices{notice(NoticeCode::single_readings)});
  for (MeasuredPoint& p : run.points) p.point.direction = 0;
  EXPECT_EQ(positioning_notices({run}).front(),
            inherited("run 1", notice(NoticeCode::approach_not_stated)));
  const auto unknown = build_positioning_table({run});
  EXPECT_EQ(unknown->positioning.forward, unknown->positioning.reverse);
}

TEST(ImportedTable, EqualReadingsHaveNoRepeatability) {
  mdof::Run run = imported(1, 3);
  for (MeasuredPoint& p : run.points)
    if (p.point.direction > 0 && p.target_m == 10e-3) p.point.probe_m[0] = 1e-7;
  const auto table = build_positioning_table({run});
  ASSERT_TRUE(table);
  EXPECT_TRUE(std::isnan(table->positioning.u_forward[1]));
  EXPECT_GT(table->positioning.u_forward[0], 0);
  EXPECT_GT(table->positioning.u_reverse[1], 0);
  EXPECT_EQ(positioning_notices({run}), Notices{notice(NoticeCode::single_readings)});
}

TEST(ImportedTable, RefusesIncompatibleRuns) {
  const mdof::Run first = imported(1, 2), second = imported(2, 2);
  EXPECT_EQ(refusal({first, second}), "");
  EXPECT_NE(refusal({}).find("at least one run"), std::string::npos);
  mdof::Run other = second;
  other.header.simulated = true;
  EXPECT_NE(refusal({first, other}).find("run 2 is simulated"), std::string::npos);
  EXPECT_NE(refusal({other, first}).find("run 2 is simulated"), std::string::npos);
  mdof::Run both = first;
  both.header.simulated = true;
  const auto simulated = build_positioning_table({both, other});
  ASSERT_TRUE(simulated);
  EXPECT_TRUE(simulated->simulated);
  other = second;
  other.header.axis = Axis::y;
  EXPECT_NE(refusal({first, other}).find("run 2 measures axis Y"), std::string::npos);
  other = second;
  other.header.provenance.model = "EYX";
  EXPECT_NE(refusal({first, other}).find("imported error EYX"), std::string::npos);
  other = second;
  other.header.provenance.recording_kind = "csv";
  EXPECT_NE(refusal({first, other}).find("measured by mdof"), std::string::npos);
  other = second;
  other.header.provenance.recording_sha256 = "1";
  EXPECT_NE(refusal({first, other}).find("run 1 and run 2 were imported from the same file"),
            std::string::npos);
  other = second;
  other.points[1].target_m = 10.001e-3;
  EXPECT_NE(refusal({first, other}).find("run 2 has a target at 10.001 mm"), std::string::npos);
  other = first;
  std::erase_if(other.points, [](const MeasuredPoint& p) { return p.target_m > 0; });
  EXPECT_NE(refusal({other}).find("has one target"), std::string::npos);
}

// Two targets are the same target if they differ by less than 0.1 µm in either direction.
TEST(ImportedTable, MergesTargetsWithinTenthOfAMicrometre) {
  const mdof::Run first = imported(1, 2);
  for (const double off_m : {0.099e-6, -0.099e-6}) {
    mdof::Run other = imported(2, 2);
    other.points[1].target_m += off_m;
    EXPECT_EQ(refusal({first, other}), "") << off_m;
    other.points[1].target_m += off_m / 0.099 * 0.002;
    EXPECT_NE(refusal({first, other}).find("run 2 has a target at"), std::string::npos) << off_m;
  }
}

TEST(ImportedTable, TakesTheAxisOfItsRuns) {
  mdof::Run run = imported(1, 1);
  run.header.axis = Axis::y;
  run.header.provenance.model = "EYY";
  const auto table = build_positioning_table({run});
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_EQ(table->axis, Axis::y);
  EXPECT_FALSE(table->slope_removed);
}

TEST(ImportedTable, FindsTheNearestTarget) {
  const std::vector<double> targets = {0, 10e-3, 30e-3};
  for (const auto& [at_m, place] : {std::pair{-5e-3, 0},
                                    {0.0, 0},
                                    {4.9e-3, 0},
                                    {5.1e-3, 1},
                                    {10e-3, 1},
                                    {19.9e-3, 1},
                                    {20.1e-3, 2},
                                    {30e-3, 2},
                                    {90e-3, 2}})
    EXPECT_EQ(target_at(targets, at_m), static_cast<std::size_t>(place)) << at_m;
  EXPECT_EQ(imported_targets({{.position_m = 10e-3},
                              {.position_m = 0},
                              {.position_m = 10.00005e-3},
                              {.position_m = 10.0002e-3}}),
            (std::vector<double>{0, 10e-3, 10.0002e-3}));
}

// If the body moves in the negative direction when the command increases (`against`), imported runs
// must state the travel "-", otherwise the travel "+".
TEST(ImportedTable, RefusesTravelThatContradictsTheMachine) {
  const auto built = [](const char* options, std::optional<bool> against) {
    mdof::Run run = imported(7, 1);
    run.header.provenance.options_json = options;
    return build_positioning_table({run}, against);
  };
  for (const bool against : {false, true}) {
    const auto stated = built(
        against ? R"({"imported":{"travel":"-"}})" : R"({"imported":{"travel":"+"}})", against);
    EXPECT_TRUE(stated) << stated.error().message;
    EXPECT_TRUE(built("{}", against));
    const auto other = built(
        against ? R"({"imported":{"travel":"+"}})" : R"({"imported":{"travel":"-"}})", against);
    ASSERT_FALSE(other);
    EXPECT_NE(other.error().message.find("run 7 was imported with travel \"" +
                                         std::string(against ? "+" : "-") + "\""),
              std::string::npos)
        << other.error().message;
  }
}

// With the sense "body" the readings change their sign if the body moves against the command. With
// the sense of the command the sign never changes.
TEST(ImportedTable, NegativeTravelChangesTheSignOfSenseBody) {
  const auto built = [](const char* options, std::optional<bool> against = std::nullopt) {
    mdof::Run run = imported(7, 1);
    run.header.provenance.options_json = options;
    return build_positioning_table({run}, against);
  };
  const auto middle = [](const Result<CompensationTable>& table) {
    return table ? table->positioning.forward[1] * 1e6 : std::nan("");
  };
  const char* const body = R"({"imported":{"sense":"body"}})";
  EXPECT_NEAR(middle(built(R"({"imported":{"sense":"body","travel":"-"}})")), -1.1, 1e-9);
  EXPECT_NEAR(middle(built(R"({"imported":{"sense":"body","travel":"+"}})")), 1.1, 1e-9);
  EXPECT_NEAR(middle(built(R"({"imported":{"travel":"-"}})")), 1.1, 1e-9);
  EXPECT_NEAR(middle(built(body, true)), -1.1, 1e-9);
  EXPECT_NEAR(middle(built(body, false)), 1.1, 1e-9);
  const auto unknown = built(body);
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().message.find("run 7 was imported with the sense \"body\""),
            std::string::npos);
}

// Two targets are enough, and so are two readings of a target: 3.1 and 3.5 µm have s = 0.4/√2 µm
// and u = 0.2 µm.
TEST(ImportedTable, TwoReadingsAtTwoTargetsAreEnough) {
  mdof::Run run = imported(1, 2, 0.3e-6);
  std::erase_if(run.points, [](const MeasuredPoint& p) { return p.target_m > 15e-3; });
  run.points[1].point.probe_m = {3.1e-6};  // first and second reading of the second target, forward
  run.points[5].point.probe_m = {3.5e-6};
  const auto table = build_positioning_table({run});
  ASSERT_TRUE(table) << table.error().message;
  EXPECT_NEAR(table->positioning.forward[1], 3.3e-6, 1e-18);
  EXPECT_NEAR(table->positioning.u_forward[1], 0.2e-6, 1e-18);
  for (const auto& u : table->u_declared) {
    ASSERT_EQ(u.size(), 2u);
    EXPECT_TRUE(std::isnan(u[0]) && std::isnan(u[1]));
  }
}

}  // namespace
}  // namespace mdof::algo
