#include "schema/base/json_writer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>

namespace mdof {
namespace {

std::string string_value(std::string_view text) {
  return JsonWriter().value(text).take();
}

TEST(JsonWriter, PutsCommasBetweenMembers) {
  JsonWriter json;
  json.begin_object().field("a", 1).key("b").begin_array().value(1.5).value(true).null();
  json.begin_object().end_object().begin_array().end_array().end_array();
  json.field("c", "x").key("d").begin_object().field("e", false).end_object().end_object();
  EXPECT_EQ(json.text(), R"({"a":1,"b":[1.5,true,null,{},[]],"c":"x","d":{"e":false}})");
}

TEST(JsonWriter, WritesIntegersInFull) {
  JsonWriter json;
  json.begin_array();
  json.value(std::numeric_limits<std::int64_t>::min());
  json.value(std::numeric_limits<std::uint64_t>::max()).end_array();
  EXPECT_EQ(json.text(), "[-9223372036854775808,18446744073709551615]");
}

TEST(JsonWriter, WritesMinusZeroAsZero) {
  EXPECT_EQ(JsonWriter().value(-0.0).take(), "0");
  EXPECT_EQ(JsonWriter().value(0.0).take(), "0");
}

TEST(JsonWriter, WritesDoublesThatReadBackToTheSameBits) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 100'000; ++i) {
    const double x = std::bit_cast<double>(random());
    if (!std::isfinite(x)) continue;
    const std::string text = JsonWriter().value(x).take();
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(text.c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(x));
  }
}

TEST(JsonWriter, WritesNullForNonFiniteNumbers) {
  JsonWriter json;
  json.begin_array()
      .value(double{NAN})
      .value(double{INFINITY})
      .value(-double{INFINITY})
      .end_array();
  EXPECT_EQ(json.text(), "[null,null,null]");
}

TEST(JsonWriter, EscapesSpecialCharacters) {
  EXPECT_EQ(string_value("a\"b\\c\n\r\t\x01\x1f/"), R"("a\"b\\c\n\r\t\u0001\u001f/")");
  EXPECT_EQ(string_value(std::string_view("\0", 1)), R"("\u0000")");
  EXPECT_EQ(JsonWriter().begin_object().field("k\"", 1).end_object().take(), R"({"k\"":1})");
}

TEST(JsonWriter, KeepsUtf8) {
  for (const char* text : {"µm", "€", "\xf0\x9f\x94\xa7", "\xed\x9f\xbf", "\xf4\x8f\xbf\xbf"})
    EXPECT_EQ(string_value(text), '"' + std::string(text) + '"');
}

TEST(JsonWriter, ReplacesBytesThatAreNotUtf8) {
  const std::string bad = "\xef\xbf\xbd";
  EXPECT_EQ(string_value("a\xff"
                         "b"),
            "\"a" + bad + "b\"");
  EXPECT_EQ(string_value("\xc3"), '"' + bad + '"');            // an incomplete character
  EXPECT_EQ(string_value("\xc0\x80"), '"' + bad + bad + '"');  // a longer encoding than necessary
  EXPECT_EQ(string_value("\xed\xa0\x80"), '"' + bad + bad + bad + '"');  // a surrogate
  // Greater than U+10FFFF.
  EXPECT_EQ(string_value("\xf4\x90\x80\x80"), '"' + bad + bad + bad + bad + '"');
}

TEST(JsonWriter, InsertsRawJsonUnchanged) {
  JsonWriter json;
  json.begin_object().key("a").raw("[1, 2]").field("b", 2).end_object();
  EXPECT_EQ(json.take(), R"({"a":[1, 2],"b":2})");
}

}  // namespace
}  // namespace mdof
