// Tests the limits of the options for the targets of a run in motion.
#include "algo/on_the_fly/target_grid.h"

#include <gtest/gtest.h>

#include <limits>

namespace mdof::algo {
namespace {

std::string options_error(const OnTheFlyOptions& options,
                          const std::vector<double>& targets_m = {}) {
  const Status checked = check_on_the_fly(options, targets_m);
  return checked ? "" : checked.error().message;
}

OnTheFlyOptions grid(double interval_mm, double bin_mm = 0, std::optional<double> from_mm = {},
                     std::optional<double> to_mm = {}) {
  OnTheFlyOptions options;
  options.interval_mm = interval_mm;
  options.bin_mm = bin_mm;
  options.from_mm = from_mm;
  options.to_mm = to_mm;
  return options;
}

TEST(TargetGridLimits, ErrorsNameTheKey) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(options_error(grid(1)), "");
  EXPECT_NE(options_error(grid(-1)).find("interval_mm must be a finite number and not negative"),
            std::string::npos);
  EXPECT_NE(options_error(grid(0)).find("because no targets are given"), std::string::npos);
  EXPECT_EQ(options_error(grid(0), {0, 1e-3}), "");
  for (const double bad : {nan, kInfinity}) {
    EXPECT_NE(options_error(grid(1, 0, bad)).find("from_mm, to_mm must be numbers"),
              std::string::npos);
    EXPECT_NE(options_error(grid(1, 0, 0, bad)).find("from_mm, to_mm must be numbers"),
              std::string::npos);
    EXPECT_NE(options_error(grid(bad)).find("interval_mm"), std::string::npos);
    EXPECT_NE(options_error(grid(1, bad)).find("bin_mm"), std::string::npos);
  }
  EXPECT_NE(options_error(grid(1, 0, 5, 5)).find("to_mm must be greater"), std::string::npos);
  EXPECT_EQ(options_error(grid(1, 0, 0, 9999)), "");
  EXPECT_NE(options_error(grid(1, 0, 0, 10000)).find("more than 10000 targets"), std::string::npos);
  EXPECT_EQ(options_error(grid(2, 2)), "");
  EXPECT_NE(
      options_error(grid(2, 2.1)).find("bin_mm must not exceed the interval of the targets, 2 mm"),
      std::string::npos);
  EXPECT_EQ(options_error(grid(0.001)), "");
  EXPECT_NE(options_error(grid(0.0009)).find("must be 0.001 or more"), std::string::npos);
  EXPECT_NE(options_error(grid(1, 0.0009)).find("must be 0.001 or more"), std::string::npos);
  EXPECT_EQ(options_error(grid(1, 0.001)), "");
}

TEST(TargetGridLimits, BinLengthIsTheIntervalUpToOneMillimetre) {
  EXPECT_NEAR(TargetGrid(grid(0.4), {}).bin_m(), 0.4e-3, 1e-15);
  EXPECT_NEAR(TargetGrid(grid(5), {}).bin_m(), 1e-3, 1e-15);
  EXPECT_NEAR(TargetGrid(grid(0), {0, 3e-3, 3.25e-3}).bin_m(), 0.25e-3, 1e-15);
}

// The whole bin of a target must be within the range. From -3.5 to 2.5 mm, the targets are -3 to 2
// mm.
TEST(TargetGridLimits, WholeBinsMustLieWithinTheRange) {
  const TargetGrid whole(grid(1), {});
  const auto found = whole.between(-3.5e-3, 2.5e-3, 100);
  ASSERT_EQ(found.size(), 6U);
  EXPECT_NEAR(found.front().position_m, -3e-3, 1e-15);
  EXPECT_NEAR(found.back().position_m, 2e-3, 1e-15);
  EXPECT_EQ(whole.between(-3.4e-3, 2.4e-3, 100).size(), 4U);
  EXPECT_EQ(whole.between(-3.5e-3, 2.5e-3, 6).size(), 6U);
  EXPECT_TRUE(whole.between(-3.5e-3, 2.5e-3, 5).empty());
  EXPECT_TRUE(whole.known().empty());
}

// The largest accepted range has 10,000 targets. The last target is at 9,999 mm.
TEST(TargetGridLimits, AllTargetsOfARangeAreKnown) {
  const auto known = TargetGrid(grid(1, 0, 0, 9999), {}).known();
  ASSERT_EQ(known.size(), 10000U);
  EXPECT_NEAR(known.back().position_m, 9.999, 1e-12);
  EXPECT_EQ(TargetGrid(grid(0), {1e-3, 2e-3, 7e-3}).known().size(), 3U);
  EXPECT_TRUE(TargetGrid(grid(1, 0, 0), {}).known().empty());
}

// JSON text of the options, which is stored with a run.
TEST(TargetGridOptions, JsonContainsTheGivenRange) {
  EXPECT_EQ(OnTheFlyOptions().json(), R"({"interval_mm":1,"bin_mm":0})");
  EXPECT_EQ(grid(2.5, 0.5, -3).json(), R"({"interval_mm":2.5,"bin_mm":0.5,"from_mm":-3})");
  EXPECT_EQ(grid(2, 1, {}, 40).json(), R"({"interval_mm":2,"bin_mm":1,"to_mm":40})");
}

}  // namespace
}  // namespace mdof::algo
