#include "schema/base/output/wrapped.h"

#include <gtest/gtest.h>

namespace mdof {
namespace {

TEST(Wrapped, BreaksBetweenWordsAndCountsCharacters) {
  EXPECT_EQ(text_width("µm…"), 3u);
  EXPECT_EQ(wrapped("one two three", 7), "one two\nthree");
  EXPECT_EQ(wrapped("µµµ µµµ", 7), "µµµ µµµ");
  EXPECT_EQ(wrapped("one two three", 7, 2), "one two\n  three");
  EXPECT_EQ(wrapped("a /a/long/path b", 6), "a\n/a/long/path\nb");
}

TEST(Fitted, LeavesLinesThatFitAndKeepsTheirSpaces) {
  EXPECT_EQ(fitted("a  b\n\n  c\n", 10), "a  b\n\n  c\n");
  EXPECT_EQ(fitted("one two three\nfour\n", 8), "one two\n  three\nfour\n");
  EXPECT_EQ(fitted("  one two three", 9, 2), "  one two\n    three");
  EXPECT_EQ(fitted("  one two three", 9, 0), "  one two\n  three");
}

}  // namespace
}  // namespace mdof
