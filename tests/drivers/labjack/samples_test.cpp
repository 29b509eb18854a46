#include "drivers/labjack/samples.h"

#include <gtest/gtest.h>

#include <limits>

namespace mdof::drivers::labjack {
namespace {

TEST(LabjackVolts, ConvertsWithNominalConstants) {
  const AinCalibration c = nominal_calibration(0);
  EXPECT_NEAR(volts(c, 0), -10.586757, 1e-5);
  EXPECT_EQ(volts(c, 33523), 0);
  EXPECT_NEAR(volts(c, 32768), -0.238433, 1e-6);
  EXPECT_NEAR(volts(c, 65535), 10.109575, 1e-5);
  EXPECT_NEAR(volts(nominal_calibration(2), 65535), 0.10109575, 1e-7);
}

// U6 and T7. At gain 1 the nominal slopes are 0.00031580578 and -0.0003158058 V per code. The
// slope of each further gain is a tenth of the previous slope. The centre is code 33523. Sources:
// LabJackPython, src/u6.py, CalibrationInfo; LabJack's T7 example stream.c.
TEST(LabjackVolts, EachFurtherGainHasATenthOfTheSlope) {
  const double lowest_v[] = {-10.586757, -1.0586757, -0.10586757, -0.010586757};
  const double highest_v[] = {10.109575, 1.0109575, 0.10109575, 0.010109575};
  for (std::size_t gain = 0; gain < 4; ++gain) {
    const AinCalibration c = nominal_calibration(gain);
    EXPECT_NEAR(volts(c, 0) / lowest_v[gain], 1, 1e-6) << gain;
    EXPECT_NEAR(volts(c, 65535) / highest_v[gain], 1, 1e-6) << gain;
    EXPECT_EQ(c.centre, 33523) << gain;
  }
}

TEST(LabjackVolts, EachSideOfTheCentreHasItsSlope) {
  const AinCalibration c{2e-4, -3e-4, 1000};
  EXPECT_NEAR(volts(c, 1010), 2e-3, 1e-9);
  EXPECT_NEAR(volts(c, 990), -3e-3, 1e-9);
}

TEST(LabjackVolts, ConstantsFarFromNominalAreRefused) {
  for (std::size_t gain = 0; gain < 4; ++gain) {
    EXPECT_TRUE(check(nominal_calibration(gain), gain));
    EXPECT_FALSE(check(nominal_calibration(gain), (gain + 1) % 4));
  }
  AinCalibration c = nominal_calibration(0);
  c.negative_slope = -c.negative_slope;
  EXPECT_FALSE(check(c, 0));
  c = nominal_calibration(0);
  c.centre = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(check(c, 0));
}

std::vector<std::uint64_t> indices(const std::vector<Scan>& scans) {
  std::vector<std::uint64_t> all;
  for (const Scan& scan : scans) all.push_back(scan.index);
  return all;
}

using Words = std::vector<std::uint16_t>;
constexpr std::uint16_t kOnes = 0xFFFF;

TEST(LabjackScanSplitter, ScansExtendOverPackets) {
  ScanSplitter line(3);
  std::vector<Scan> scans;
  for (const Words& packet : {Words{1, 2}, Words{3, 4, 5, 6, 7}, Words{8, 9}})
    ASSERT_TRUE(line.take(packet, std::nullopt, scans));
  ASSERT_EQ(indices(scans), (std::vector<std::uint64_t>{0, 1, 2}));
  EXPECT_EQ(scans[1].words, (Words{4, 5, 6}));
}

TEST(LabjackScanSplitter, MarkOfAGapMayExtendOverPackets) {
  ScanSplitter line(3);
  std::vector<Scan> scans;
  ASSERT_TRUE(line.take(Words{1, 2}, std::nullopt, scans));
  ASSERT_TRUE(line.take(Words{3, kOnes}, 50, scans));
  EXPECT_TRUE(scans.empty());  // the position of the gap is known only after the whole mark
  ASSERT_TRUE(line.take(Words{kOnes, kOnes, 4, 5, 6}, std::nullopt, scans));
  ASSERT_EQ(indices(scans), (std::vector<std::uint64_t>{0, 51}));
  EXPECT_EQ(scans[1].lost, 50U);
  EXPECT_EQ(scans[0].lost, 0U);
}

TEST(LabjackScanSplitter, GapWithoutItsMarkIsAnError) {
  ScanSplitter line(2);
  std::vector<Scan> scans;
  ASSERT_TRUE(line.take(Words{1, 1, kOnes}, 50, scans));
  EXPECT_FALSE(line.take(Words{2, 3, 3}, std::nullopt, scans));
  EXPECT_TRUE(scans.empty());
}

TEST(LabjackScanSplitter, AllOnesWithoutAGapAreValues) {
  ScanSplitter line(2);
  std::vector<Scan> scans;
  ASSERT_TRUE(line.take(Words{kOnes, kOnes, kOnes, kOnes}, 7, scans));
  ASSERT_TRUE(line.take(Words{kOnes, kOnes}, std::nullopt, scans));
  // The first two words are the mark of the gap.
  EXPECT_EQ(indices(scans), (std::vector<std::uint64_t>{7, 8}));
}

}  // namespace
}  // namespace mdof::drivers::labjack
