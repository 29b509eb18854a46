#include "schema/recording/run_options.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

RunOptions of(const std::string& json) {
  RunHeader run;
  run.provenance.options_json = json;
  return run_options(run);
}

TEST(RunOptions, AreReadInAnyOrderOfMembers) {
  const RunOptions options =
      of(R"({"model": "rigid", "on_the_fly": {"interval_mm": 1}, "remove_drift": true})");
  EXPECT_TRUE(options.remove_drift);
  EXPECT_TRUE(options.on_the_fly);
  const ImportedSense imported =
      of(R"({"imported": {"error": "EXX", "travel": "-", "sense": "body"}})").imported;
  EXPECT_EQ(imported.sense, PositioningSense::body);
  EXPECT_EQ(imported.against_command, true);
  EXPECT_EQ(of(R"({"imported":{"travel":"+"}})").imported.against_command, false);
}

TEST(RunOptions, OtherTextsGiveTheDefaults) {
  for (const char* text : {"", "{", "[]", "{}", R"({"remove_drift": "yes"})",
                           R"({"imported":{"about":["\"sense\":\"body\"", "\"travel\":\"-\""]}})",
                           R"({"note":{"remove_drift":true}})"}) {
    const RunOptions options = of(text);
    EXPECT_FALSE(options.remove_drift) << text;
    EXPECT_FALSE(options.on_the_fly) << text;
    EXPECT_EQ(options.imported.sense, PositioningSense::command) << text;
    EXPECT_EQ(options.imported.against_command, std::nullopt) << text;
  }
}

}  // namespace
}  // namespace mdof
