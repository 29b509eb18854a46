// Units of the D-SI format. The expected values were calculated by hand.
#include "schema/dcc/si_unit.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

void expect(const char* text, double factor, int metre, int volt) {
  const auto unit = si_unit(text);
  ASSERT_TRUE(unit) << text;
  EXPECT_DOUBLE_EQ(unit->factor, factor) << text;
  EXPECT_EQ(unit->metre, metre) << text;
  EXPECT_EQ(unit->volt, volt) << text;
}

TEST(SiUnit, ReadsPrefixesQuotientsAndPowers) {
  expect("\\metre", 1, 1, 0);
  expect(" \\micro\\metre ", 1e-6, 1, 0);
  expect("\\volt", 1, 0, 1);
  expect("\\volt\\per\\micro\\metre", 1e6, -1, 1);
  expect("\\milli\\volt\\per\\micro\\metre", 1e3, -1, 1);
  expect("\\per\\metre\\volt", 1, -1, 1);  // \per applies only to the next unit
  expect("\\volt\\metre\\tothe{-1}", 1, -1, 1);
  expect("\\volt\\milli\\metre\\tothe{-1}", 1e3, -1, 1);
  expect("\\micro\\metre\\per\\volt", 1e-6, 1, -1);
  expect("\\centi\\metre\\tothe{2}", 1e-4, 2, 0);
}

TEST(SiUnit, RejectsOtherUnits) {
  for (const char* text :
       {"", "\\", "metre", "\\kelvin", "\\one", "\\volt\\per\\kelvin", "\\per", "\\micro",
        "\\micro\\per\\metre", "\\metre\\tothe", "\\metre\\tothe{}", "\\metre\\tothe{x}",
        "\\metre\\tothe{-1", "\\metre\\tothe{99}", "\\metre um", "\\metre\\tothe{1e9}"})
    EXPECT_FALSE(si_unit(text)) << text;
}

}  // namespace
}  // namespace mdof
