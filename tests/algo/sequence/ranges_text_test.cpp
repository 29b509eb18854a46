#include "algo/sequence/ranges_text.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

TEST(RangesText, ThreeInARowAreARange) {
  EXPECT_EQ(ranges_text({}), "");
  EXPECT_EQ(ranges_text({4}), "4");
  EXPECT_EQ(ranges_text({4, 5}), "4, 5");
  EXPECT_EQ(ranges_text({4, 5, 6}), "4 to 6");
  EXPECT_EQ(ranges_text({1, 2, 3, 4, 5, 7, 8}), "1 to 5, 7, 8");
  EXPECT_EQ(ranges_text({2, 4, 6}), "2, 4, 6");
  EXPECT_EQ(ranges_text({-1, 0, 1, 9, 20, 21, 22}), "-1 to 1, 9, 20 to 22");
}

TEST(RangesText, OneNumberHasTheSingular) {
  EXPECT_EQ(numbered("target", {7}), "target 7");
  EXPECT_EQ(numbered("target", {1, 2}), "targets 1, 2");
  EXPECT_EQ(numbered("run", {1, 2, 3}), "runs 1 to 3");
}

}  // namespace
}  // namespace mdof::algo
