// The counts alone must show whether the axis has passed the reference mark.
#include "drivers/counter/index_mark.h"

#include <gtest/gtest.h>

#include "drivers/counter/unwrap.h"

namespace mdof::drivers {
namespace {

using State = IndexMark::State;

constexpr std::int64_t kQuarter = 1 << 22;  // a quarter of the range of 24 bits

TEST(IndexMark, PassedAfterThreeReadingsAwayFromTheMark) {
  IndexMark mark(24);
  EXPECT_EQ(mark.take(5), State::off);
  EXPECT_EQ(mark.arm(1000), static_cast<std::uint64_t>(kQuarter + 1000));
  EXPECT_EQ(mark.take(1001), State::awaited);
  EXPECT_EQ(mark.take(-70'000), State::awaited);
  EXPECT_EQ(mark.take(kQuarter + 1002), State::at_mark);
  EXPECT_EQ(mark.take(kQuarter + 1016), State::at_mark);
  // 17 counts from the mark are far enough. This is the first of the three readings that are
  // needed.
  EXPECT_EQ(mark.take(kQuarter + 1017), State::at_mark);
  EXPECT_EQ(mark.take(kQuarter + 1500), State::at_mark);
  EXPECT_EQ(mark.take(kQuarter + 1510), State::passed);
  EXPECT_EQ(mark.from_mark(kQuarter + 1510), 510);
  EXPECT_EQ(mark.from_mark(kQuarter - 9000), -10'000);
  EXPECT_EQ(mark.take(-5), State::passed);  // after this, every count is accepted
}

TEST(IndexMark, PassedInReverse) {
  IndexMark mark(32);
  const auto load = static_cast<std::int64_t>(mark.arm(-3));
  EXPECT_EQ(load, (std::int64_t{1} << 30) - 3);
  for (const int back : {1, 20, 40}) EXPECT_EQ(mark.take(load - back), State::at_mark) << back;
  EXPECT_EQ(mark.take(load - 60), State::passed);
  EXPECT_EQ(mark.from_mark(load - 60), -60);
}

// If the polarity of the index is wrong, the counter is loaded at three of four positions. Its
// count therefore stays near the preset.
TEST(IndexMark, NeverPassedWithTheWrongPolarity) {
  IndexMark mark(24);
  mark.arm(0);
  for (int i = 0; i < 10'000; ++i) EXPECT_EQ(mark.take(kQuarter + i % 4), State::at_mark);
}

TEST(IndexMark, ImpossibleCountIsNotTheMark) {
  IndexMark mark(24);
  mark.arm(0);
  const std::int64_t near = kQuarter / 64;
  for (const std::int64_t count :
       {kQuarter - near - 1, kQuarter + near + 1, 3 * kQuarter, -kQuarter, kQuarter / 2 + 1}) {
    EXPECT_EQ(mark.take(count), State::unexplained) << count;
    EXPECT_EQ(mark.take(7), State::awaited);
  }
  EXPECT_EQ(mark.take(kQuarter - near), State::at_mark);
  // One damaged reading that looks like the mark is ignored.
  EXPECT_EQ(mark.take(8), State::awaited);
  EXPECT_EQ(mark.take(kQuarter + 30), State::at_mark);
  EXPECT_EQ(mark.take(kQuarter + 31), State::at_mark);
  EXPECT_EQ(mark.take(kQuarter * 2), State::unexplained);
  EXPECT_EQ(mark.take(9), State::awaited);
  EXPECT_EQ(mark.take(kQuarter + 33), State::at_mark);  // three readings are needed again
  EXPECT_EQ(mark.take(kQuarter + 34), State::at_mark);
  EXPECT_EQ(mark.take(kQuarter + 35), State::passed);
}

TEST(IndexMark, CounterWithFewBitsIsArmedAgainFarAway) {
  IndexMark mark(24);
  mark.arm(100);
  EXPECT_FALSE(mark.far_from_armed(100 + kQuarter / 4));
  EXPECT_TRUE(mark.far_from_armed(101 + kQuarter / 4));
  EXPECT_TRUE(mark.far_from_armed(99 - kQuarter / 4));
}

// After the counter was loaded, its unwrapped count must equal the preset, also for counts near
// the end of the 32 bits.
TEST(IndexMark, PresetEqualsTheUnwrappedCount) {
  for (const std::uint32_t start : {0u, 0x4000'0000u, 0x7FFF'FFF0u, 0xC000'0000u, 0xFFFF'FFFFu}) {
    Unwrap unwrap(32, true);
    IndexMark mark(32);
    const auto load = static_cast<std::uint32_t>(mark.arm(unwrap(start)));
    EXPECT_EQ(mark.take(unwrap(start + 50u)), State::awaited) << start;
    EXPECT_EQ(mark.take(unwrap(load + 20u)), State::at_mark) << start;
    EXPECT_EQ(mark.take(unwrap(load + 21u)), State::at_mark);
    EXPECT_EQ(mark.take(unwrap(load + 22u)), State::passed);
    EXPECT_EQ(mark.from_mark(unwrap(load - 7u)), -7);
  }
}

}  // namespace
}  // namespace mdof::drivers
