#include "schema/flag/point_flag.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

// Databases contain these names. If a flag were renamed, older runs could not be read.
TEST(PointFlag, HasTheNameStoredInDatabases) {
  const std::vector<std::string> stored = {
      "approach_assumed", "creep",       "frozen:A",      "gap",
      "gap_closed:?",     "interrupted", "jump",          "lost:B",
      "missing:encoder",  "no_air",      "overshot",      "residual",
      "saturated:\"C\"",  "slow:D",      "spike:encoder", "step:E:2",
      "truncated"};
  std::vector<PointFlag> flags;
  for (const std::string& text : stored) {
    const auto flag = point_flag_from(text);
    ASSERT_TRUE(flag) << text;
    flags.push_back(*flag);
    EXPECT_EQ(static_cast<std::size_t>(flag->flag), flags.size() - 1) << text;
  }
  EXPECT_EQ(flag_texts(flags), stored);
  EXPECT_EQ(flags[2], (PointFlag{Flag::frozen, "A"}));
  EXPECT_EQ(flags[15].channel, "E:2");
  EXPECT_EQ(to_string({{Flag::lost, "B"}, {Flag::gap}}), "lost:B gap");
}

TEST(PointFlag, RejectsUnknownNames) {
  for (const char* text : {"", "lst:A", "LOST:A", ":A", "gap "}) {
    const auto flag = point_flag_from(text);
    ASSERT_FALSE(flag) << text;
    EXPECT_NE(flag.error().message.find("\"" + std::string(text) + "\""), std::string::npos);
  }
}

}  // namespace
}  // namespace mdof
