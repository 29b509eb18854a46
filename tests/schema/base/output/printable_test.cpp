#include "schema/base/output/printable.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

TEST(Printable, KeepsReadableText) {
  for (const char* const text :
       {"", "two\nlines\tand a tab", "5 µm ± 0.1 µrad", "工具机", "🙂", "é"}) {
    EXPECT_TRUE(is_printable(text)) << text;
    EXPECT_EQ(printable(text), text);
  }
}

TEST(Printable, ReplacesEachControlCharacter) {
  const std::pair<std::string, std::string> rows[] = {
      {"a\x1b]0;title\x07z", "a?]0;title?z"},
      {"\x1b[2J", "?[2J"},
      {"over\rwritten\b", "over?written?"},
      {std::string("a\0b", 3), "a?b"},
      {"\x7f", "?"},
      {"\xc2\x9b"
       "31m",
       "?31m"},  // U+009B is CSI (control sequence introducer) as one character
      {"\xc2\x85", "?"},
      {"\xe2\x80\xae"
       "abc",
       "?abc"},  // right-to-left override
      {"\xe2\x81\xa6", "?"},
  };
  for (const auto& [text, clean] : rows) {
    EXPECT_FALSE(is_printable(text)) << clean;
    EXPECT_EQ(printable(text), clean);
  }
}

TEST(Printable, ReplacesEachInvalidByte) {
  const std::pair<std::string, std::string> rows[] = {
      {"\x9b", "?"},           {"\xfc", "?"},
      {"µ\xb5µ", "µ?µ"},       {"\xc2", "?"},
      {"\xe2\x80", "??"},      {"\xc0\x9b", "??"},
      {"\xe0\x82\x9b", "???"},  // a longer encoding than necessary
      {"\xed\xa0\x80", "???"}, {"\xf4\x90\x80\x80", "????"},
      {"\xc2\x1b", "??"},
  };
  for (const auto& [text, clean] : rows) EXPECT_EQ(printable(text), clean);
}

TEST(Printable, EscapesWithinJson) {
  EXPECT_EQ(printable_json("{\"a\":\"µ\x7f\xc2\x9b\xe2\x80\xae\xff\"}"),
            "{\"a\":\"µ\\u007f\\u009b\\u202e\\ufffd\"}");
}

}  // namespace
}  // namespace mdof
