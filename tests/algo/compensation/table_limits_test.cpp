#include "algo/compensation/table_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

std::string refusal(bool angle, std::vector<double> values, const TableLimits& limits = {}) {
  const Status done = check_limits("EXX forward", angle, {0, 0.01, 0.04}, values, limits);
  return done ? "" : done.error().message;
}

void expect_message_contains(const std::string& text, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(text.find(part), std::string::npos) << text;
}

TEST(TableLimits, ValueAndSlopeUpToTheLimitPass) {
  EXPECT_EQ(refusal(false, {0, 0.5e-3, 1e-3}), "");  // 50 um/mm, 1 mm
  EXPECT_EQ(refusal(true, {0, 5e-3, 10e-3}), "");
  EXPECT_EQ(refusal(false, {kNaN, kNaN, kNaN}), "");
}

TEST(TableLimits, ReportsPositionLimitAndRemedy) {
  expect_message_contains(refusal(false, {0, 0.2e-3, 1.01e-3}),
                          {"EXX forward", "1010 um at 40 mm", "the limit of 1000 um"});
  expect_message_contains(refusal(false, {0, 0.51e-3, 0.5e-3}),
                          {"51 um/mm from 0 mm to 10 mm", "limit is 50 um/mm"});
  EXPECT_EQ(check_limits("EXX", false, {0, 0.01}, {0, 1.01e-3}, {}).error().remedy,
            Remedy::raise_value_limit);
  EXPECT_EQ(check_limits("EXX", false, {0, 0.01}, {0, 0.51e-3}, {}).error().remedy,
            Remedy::raise_slope_limit);
  expect_message_contains(refusal(true, {0, -5.1e-3, 0}), {"-510 urad/mm", "500 urad/mm"});
  expect_message_contains(refusal(false, {0, kNaN, -2.4e-3}), {"-2400 um at 40 mm"});
  expect_message_contains(refusal(false, {0, 1e302, 0}), {"at 10 mm", "the limit"});
  expect_message_contains(refusal(false, {0, std::numeric_limits<double>::infinity(), 0}),
                          {"at 10 mm"});
  // The slope limit also applies between the neighbours of a missing value.
  expect_message_contains(refusal(true, {-9e-3, kNaN, 9.9e-3 + 3e-3}), {"the limit"});
}

TEST(TableLimits, OptionsRaiseLimitsUpToAMaximum) {
  const double um = 3000, slope = 200;
  const auto raised = TableLimits::asked(&um, &slope);
  ASSERT_TRUE(raised);
  EXPECT_EQ(refusal(false, {0, 1.9e-3, 2.9e-3}, *raised), "");
  expect_message_contains(refusal(false, {0, 1.9e-3, 3.1e-3}, *raised), {"3100 um"});
  const double most_um = 1e5, steepest = 500;
  EXPECT_TRUE(TableLimits::asked(&most_um, &steepest));
  for (const double wrong : {0.0, -1.0, 1e6, std::numeric_limits<double>::infinity(), kNaN}) {
    EXPECT_FALSE(TableLimits::asked(&wrong, nullptr)) << wrong;
    EXPECT_FALSE(TableLimits::asked(nullptr, &wrong)) << wrong;
  }
}

TEST(TableLimits, ApplyToEachErrorAndApproach) {
  const auto refused = [](auto spoil) {
    CompensationTable table;
    table.position_m = {0, 0.01};
    for (auto* group : {&table.forward, &table.reverse}) group->fill({0, 1e-6});
    spoil(table);
    const Status done = check_limits(table, {});
    return done ? "" : done.error().message;
  };
  EXPECT_EQ(refused([](auto&) {}), "");
  expect_message_contains(refused([](auto& t) { t.forward[0][1] = 2e-3; }),
                          {"EYX forward: 2000 um"});
  expect_message_contains(refused([](auto& t) { t.reverse[4][0] = 0.02; }),
                          {"ECX reverse: 20000 urad"});
  expect_message_contains(refused([](auto& t) {
                            t.positioning.forward = {0, 1e-6};
                            t.positioning.reverse = {0, 6e-4};
                          }),
                          {"EXX reverse: changes by 60 um/mm"});
}

// Each option changes one limit only, for lengths and for angles.
TEST(TableLimits, OptionsAreInMicrometresAndMicrometresPerMillimetre) {
  const TableLimits usual;
  const double um = 20, slope = 80;
  const auto value = TableLimits::asked(&um, nullptr), steep = TableLimits::asked(nullptr, &slope);
  ASSERT_TRUE(value && steep);
  EXPECT_DOUBLE_EQ(value->length_m, 20e-6);
  EXPECT_DOUBLE_EQ(value->angle_rad, 20e-6);
  EXPECT_EQ(value->length_slope, usual.length_slope);
  EXPECT_DOUBLE_EQ(steep->length_slope, 0.08);
  EXPECT_DOUBLE_EQ(steep->angle_slope_rad_per_m, 0.08);
  EXPECT_EQ(steep->length_m, usual.length_m);
}

}  // namespace
}  // namespace mdof::algo
