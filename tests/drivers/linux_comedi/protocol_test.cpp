#include "drivers/linux_comedi/protocol.h"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace mdof::drivers::linux_comedi {
namespace {

template <class Sample>
std::string bytes_of(const std::vector<Sample>& samples) {
  std::string bytes(samples.size() * sizeof(Sample), '\0');
  std::memcpy(bytes.data(), samples.data(), bytes.size());
  return bytes;
}

TEST(ComediCodes, ReturnsWholeScansForAnyReadSize) {
  std::vector<std::uint16_t> narrow;
  std::vector<std::uint32_t> wide, expected;
  for (std::uint32_t i = 0; i < 300; ++i) {
    narrow.push_back(static_cast<std::uint16_t>(i * 217));
    wide.push_back(i * 14'316'557U);
    expected.push_back(narrow.back());
  }
  for (const std::size_t size : {1U, 2U, 3U, 7U, 64U, 599U, 2000U}) {
    CodeSplitter narrow_line(3, false), wide_line(3, true);
    std::vector<std::uint32_t> narrow_codes, wide_codes;
    const std::string narrow_bytes = bytes_of(narrow), wide_bytes = bytes_of(wide);
    for (std::size_t at = 0; at < narrow_bytes.size(); at += size) {
      narrow_line.take(std::string_view(narrow_bytes).substr(at, size), narrow_codes);
      ASSERT_EQ(narrow_codes.size() % 3, 0U);  // the codes are whole scans
    }
    for (std::size_t at = 0; at < wide_bytes.size(); at += size)
      wide_line.take(std::string_view(wide_bytes).substr(at, size), wide_codes);
    EXPECT_EQ(narrow_codes, expected) << size;
    EXPECT_EQ(wide_codes, wide) << size;
  }
}

TEST(ComediVolts, ConvertsNominallyByTheRange) {
  const Polynomial both = nominal({-10, 10}, 65535), one = nominal({0, 5}, 4095);
  EXPECT_EQ(volts(0, both), -10);
  EXPECT_NEAR(volts(65535, both), 10, 1e-12);
  EXPECT_NEAR(volts(32768, both), 10.0 / 65535, 1e-12);
  EXPECT_NEAR(volts(819, one), 1, 1e-12);
}

TEST(ComediVolts, EvaluatesThePolynomialAboutItsOrigin) {
  const Polynomial p{{1, 0.5, 0.25, -0.125}, 10};
  EXPECT_EQ(volts(10, p), 1);
  EXPECT_EQ(volts(12, p), 1 + 1 + 1 - 1);
  EXPECT_EQ(volts(8, p), 1 - 1 + 1 + 1);
  EXPECT_EQ(volts(14, p), 1 + 2 + 4 - 8);
}

TEST(ComediVolts, EndsOfTheRangeAreRails) {
  EXPECT_TRUE(at_rail(0, 65535));
  EXPECT_FALSE(at_rail(1, 65535));
  EXPECT_FALSE(at_rail(65534, 65535));
  EXPECT_TRUE(at_rail(65535, 65535));
  EXPECT_TRUE(at_rail(5000, 4095));  // 5000 is greater than the largest code
}

TEST(ComediRanges, FindsRangesByTheirLimits) {
  const std::vector<Range> ranges = {{0, 10, false}, {-10, 10}, {-5, 5}, {0, 10}};
  EXPECT_EQ(range_index(ranges, -10, 10), 1U);
  EXPECT_EQ(range_index(ranges, -5, 5), 2U);
  EXPECT_EQ(range_index(ranges, 0, 10), 3U);  // the range of 0 to 10 mA is not a voltage
  EXPECT_FALSE(range_index(ranges, 0, 5));
  EXPECT_FALSE(range_index(ranges, -10, 5));
  EXPECT_EQ(text_of(ranges[2]), "-5 to 5 V");
  EXPECT_EQ(text_of(ranges[0]), "0 to 10");
}

TEST(ComediReferences, ReferencesHaveNames) {
  for (const auto reference :
       {Reference::ground, Reference::common, Reference::differential, Reference::other})
    EXPECT_EQ(reference_of(name_of(reference)), reference);
  EXPECT_EQ(reference_of("differential"), Reference::differential);
  EXPECT_FALSE(reference_of("diff"));
}

class ComediCommand : public testing::Test {
 protected:
  ComediCommand() {
    sources_.start.source = kNow;
    sources_.scan_begin.source = kTimer | kFollow;
    sources_.convert.source = kTimer;
    sources_.stop.source = kNone | kCount;
  }
  Result<Command> command(double rate_hz, std::optional<double> convert_us = std::nullopt) {
    return timed_command(sources_, 2, inputs_, {rate_hz, convert_us});
  }
  std::string refusal() {
    const auto made = command(100);
    return made ? "taken" : made.error().message;
  }
  Command sources_;
  std::vector<BoardInput> inputs_ = {{0, 1, Reference::ground}, {3, 0, Reference::differential}};
};

TEST_F(ComediCommand, UsesTimersForScansAndInputs) {
  const auto made = command(4000);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->subdevice, 2U);
  EXPECT_EQ(made->flags, 0U);
  EXPECT_EQ(made->start.source, kNow);
  EXPECT_EQ(made->scan_begin.source, kTimer);
  EXPECT_EQ(made->scan_begin.argument, 250'000U);
  EXPECT_EQ(made->convert.source, kTimer);
  EXPECT_EQ(made->convert.argument, 20'000U);
  EXPECT_EQ(made->scan_end.source, kCount);
  EXPECT_EQ(made->scan_end.argument, 2U);
  EXPECT_EQ(made->stop.source, kNone);
  EXPECT_EQ(made->stop.argument, 0U);
  EXPECT_EQ(rate_of(*made), 4000);
  EXPECT_EQ(convert_us(*made), 20);
  EXPECT_EQ(command(4000, 50)->convert.argument, 50'000U);
  // 20 us per input would take longer than half a scan.
  EXPECT_EQ(command(50'000)->convert.argument, 10'000U);
}

TEST_F(ComediCommand, ReadsInputsSimultaneouslyIfPossible) {
  sources_.convert.source = kTimer | kNow;
  EXPECT_EQ(command(1000)->convert.source, kNow);
  EXPECT_EQ(command(1000)->convert.argument, 0U);
  EXPECT_EQ(convert_us(*command(1000)), 0);
  EXPECT_EQ(command(1000, 5)->convert.source, kTimer);
  EXPECT_EQ(command(1000, 5)->convert.argument, 5000U);
  sources_.convert.source = kNow;
  EXPECT_FALSE(command(1000, 5));
}

TEST_F(ComediCommand, WithoutScanTimerInputsFollowWithoutPause) {
  sources_.scan_begin.source = kFollow;
  const auto made = command(4000);
  ASSERT_TRUE(made);
  EXPECT_EQ(made->scan_begin.source, kFollow);
  EXPECT_EQ(made->scan_begin.argument, 0U);
  EXPECT_EQ(made->convert.argument, 125'000U);
  EXPECT_EQ(rate_of(*made), 4000);
  EXPECT_EQ(convert_us(*made), 125);
}

TEST_F(ComediCommand, SlowScansWakeTheReaderOneByOne) {
  EXPECT_EQ(command(1000)->flags, kWakeEachScan);
  EXPECT_EQ(command(1001)->flags, 0U);
}

TEST_F(ComediCommand, StatesANumberOfScansIfTheBoardNeedsIt) {
  sources_.stop.source = kCount;
  EXPECT_EQ(command(1000)->stop.source, kCount);
  EXPECT_EQ(command(1000)->stop.argument, UINT32_MAX);
}

TEST_F(ComediCommand, RefusesBoardsWithoutTimers) {
  sources_.scan_begin.source = 0x40;  // external
  EXPECT_NE(refusal().find("no timer for scans"), std::string::npos);
  sources_.scan_begin.source = kTimer;
  sources_.convert.source = 0x40;
  EXPECT_NE(refusal().find("cannot time its conversions"), std::string::npos);
  sources_.start.source = 0x40;
  EXPECT_NE(refusal().find("cannot be started"), std::string::npos);
}

TEST(ComediSteps, FailedStepsHaveComedilibsNames) {
  EXPECT_STREQ(failed_step(3), "invalid argument");
  EXPECT_STREQ(failed_step(5), "invalid chanlist");
  EXPECT_STREQ(failed_step(6), "unknown");
  EXPECT_STREQ(failed_step(-1), "unknown");
}

}  // namespace
}  // namespace mdof::drivers::linux_comedi
