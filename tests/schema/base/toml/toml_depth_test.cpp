#include "schema/base/toml/toml_depth.h"

#include <gtest/gtest.h>

#include "schema/base/toml/toml_reader.h"

namespace mdof {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

std::string refusal(const std::string& text) {
  const auto table = TomlTable::parse(text, "rig.toml");
  return table ? "" : table.error().message;
}

// Each of these texts has caused a stack overflow, either in the parser or when the parsed tree
// was destroyed.
TEST(TomlDepth, IsLimitedBeforeParsing) {
  const std::string path = repeated("a.", 40'000) + "a";
  for (const std::string& deep :
       {path + " = 1", "[" + path + "]", "[[" + path + "]]", "a = {" + path + " = 1}",
        "a = " + repeated("[", 40'000) + repeated("]", 40'000),
        "a = " + repeated("{a=", 40'000) + "1" + repeated("}", 40'000),
        repeated("\"x.y\" . ", 40'000) + "a = 1",
        "a = " + repeated("[{" + repeated("a.", 30) + "a=", 200) + "1" + repeated("}]", 200)})
    EXPECT_EQ(refusal("name = 1\n" + deep),
              "rig.toml:2: this line is nested more than 32 levels deep (with dotted keys or "
              "brackets); use fewer levels")
        << deep.substr(0, 40);
}

TEST(TomlDepth, IsCountedExactly) {
  EXPECT_EQ(refusal(repeated("a.", 32) + "a = 1"), "");
  EXPECT_NE(refusal(repeated("a.", 33) + "a = 1"), "");
  EXPECT_EQ(refusal("a = " + repeated("[", 32) + repeated("]", 32)), "");
  EXPECT_NE(refusal("a = " + repeated("[", 33) + repeated("]", 33)), "");
  EXPECT_EQ(toml_line_over_depth("a.b.c = {d.e = [1]}", 5), std::nullopt);
  EXPECT_EQ(toml_line_over_depth("a.b.c = {d.e = [1]}", 4), 1U);
}

// Dots and brackets in strings, comments and numbers are not levels. Their number has no limit.
TEST(TomlDepth, CountsOnlyKeysAndBrackets) {
  const std::string dots = repeated(".", 100), brackets = repeated("[{", 100);
  for (const std::string& flat :
       {"# " + dots + brackets + "\na = 1", "a = \"" + dots + brackets + R"(\"[[\\")",
        "a = '" + dots + brackets + "\\'", "a = \"\"\"" + dots + "\n\"\"" + brackets + "\"\"\"\"\"",
        "a = '''" + dots + "''\n" + brackets + "'''''",
        "a = [" + repeated("[-1.5, 0.25], ", 500) + "]", repeated("[[t]]\nx.y = 1.5\n", 500),
        std::string("a = \"\" # [\nb = ''\nc = \"x\\\\\"")})
    EXPECT_EQ(refusal(flat), "") << flat.substr(0, 40);
}

// A fuzzer has found that a multi-line string without closing quotes terminated the program.
TEST(TomlDepth, RejectsAnUnterminatedString) {
  for (const char* open : {"t = \"\"\"", "t = '''", "t = '''x", "t = \"\"\"x\\", "t = '''x''",
                           "t = \"x\\", "t = \"", "t = '", "'''", "\"\"\"\"", "t = [\"\"\"a\n"}) {
    EXPECT_EQ(toml_line_over_depth(open, 32), std::nullopt) << open;
    EXPECT_NE(refusal(open).find("rig.toml:"), std::string::npos) << open;
  }
}

// Levels in the text after a string must be counted.
TEST(TomlDepth, IsCountedAfterStrings) {
  const std::string deep = "\n" + repeated("a.", 40) + "a = 1";
  for (const char* before :
       {"t = \"\"", "t = ''", "t = \"a\\\"b\"", "t = 'a\\'", "t = \"\"\"\"\"\"",
        "t = \"\"\"x\"\"\"\"\"", "t = '''x'''''", "t = 1 # \"", "t = \"#\""})
    EXPECT_NE(refusal(before + deep).find("rig.toml:2: this line is nested"), std::string::npos)
        << before;
}

}  // namespace
}  // namespace mdof
