#include "drivers/mcc_usb1608fs_plus/protocol.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/mcc_usb1608fs_plus/settings.h"
#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

using modbus::bytes;

TEST(Usb1608Protocol, EncodesTheScanStartVectors) {
  const std::string at_1kHz = bytes("00 00 00 00 3F 9C 00 00 1F 80");
  const std::string at_10kHz = bytes("00 00 00 00 9F 0F 00 00 1F 80");
  EXPECT_EQ(scan_start({0, pacer_period(1000), 0x1F, kNoStall}), at_1kHz);
  EXPECT_EQ(ScanSetup{}.scans, 0U);  // 0: the scan runs until it is stopped
  EXPECT_EQ(scan_start({0, pacer_period(10'000), 0x1F, kNoStall}), at_10kHz);
  const auto read = read_scan_start(at_1kHz);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->scans, 0U);
  EXPECT_EQ(rate_of(read->period), 1000);
  EXPECT_EQ(read->channels, 0x1F);
  EXPECT_EQ(read->options, kNoStall);
  EXPECT_EQ(rate_of(read_scan_start(at_10kHz)->period), 10'000);
  const auto finite = read_scan_start(bytes("04 03 02 01 14 13 12 11 21 31"));
  EXPECT_EQ(finite->scans, 0x01020304U);
  EXPECT_EQ(finite->period, 0x11121314U);
  EXPECT_EQ(finite->channels, 0x21);
  EXPECT_EQ(finite->options, 0x31);
  EXPECT_FALSE(read_scan_start(at_1kHz.substr(1)));
}

TEST(Usb1608Protocol, PacerPeriodsAreInRange) {
  EXPECT_EQ(pacer_period(100'000), 399U);
  EXPECT_EQ(pacer_period(1e-9), 4294967295U);
  EXPECT_EQ(pacer_period(1e9), 1U);
  EXPECT_NEAR(rate_of(pacer_period(3333)), 3333, 0.2);
}

TEST(Usb1608Protocol, ReadsTheStatus) {
  for (const bool running : {false, true})
    for (const bool overrun : {false, true}) {
      const auto status = read_status(status_reply({running, overrun}));
      ASSERT_TRUE(status);
      EXPECT_EQ(status->running, running);
      EXPECT_EQ(status->overrun, overrun);
    }
  EXPECT_EQ(status_reply({true, false}), bytes("02 00"));
  EXPECT_EQ(status_reply({false, true}), bytes("04 00"));
  EXPECT_FALSE(read_status("x"));
}

TEST(Usb1608Protocol, RangesHaveTheirCodes) {
  EXPECT_EQ(range_of(10)->code, 0);
  EXPECT_EQ(range_of(5)->code, 1);
  EXPECT_EQ(range_of(2)->code, 3);
  EXPECT_EQ(range_of(1)->code, 5);
  EXPECT_FALSE(range_of(2.5));
  EXPECT_EQ(config(3), bytes("03 03 03 03 03 03 03 03"));
}

TEST(Usb1608Protocol, ReturnsWholeScansForAnyTransferSize) {
  std::string sent;
  for (int i = 0; i < 1000; ++i) sent += {static_cast<char>(i & 0xFF), static_cast<char>(i >> 8)};
  for (const std::size_t size : {1U, 2U, 3U, 10U, 64U, 999U, 2000U}) {
    ScanSplitter line(5);
    std::vector<std::uint16_t> words;
    for (std::size_t at = 0; at < sent.size(); at += size) {
      line.take(std::string_view(sent).substr(at, size), words);
      ASSERT_EQ(words.size() % 5, 0U);
    }
    ASSERT_EQ(words.size(), 1000U);
    for (std::size_t i = 0; i < words.size(); ++i) ASSERT_EQ(words[i], i);
  }
}

TEST(Usb1608Protocol, VoltsAreNeitherRoundedNorClipped) {
  EXPECT_EQ(volts(32768, {}, 10), 0);
  EXPECT_EQ(volts(0, {}, 10), -10);
  EXPECT_NEAR(volts(65535, {}, 5), 5 * 32767.0 / 32768, 1e-12);
  EXPECT_NEAR(volts(40000, {1.01F, -100}, 10), (40000 * 1.01 - 100 - 32768) * 10 / 32768, 1e-6);
  // The result is not rounded to whole codes: half a code (0.15 mV) remains. With a slope of 1.25
  // these values are exact in binary.
  EXPECT_EQ(volts(32770, {1.25F, -8192}, 10), 0.5 * 10 / 32768 + 2 * 10.0 / 32768);
  EXPECT_EQ(volts(0, {1, -100.5F}, 10), -10 - 100.5 * 10 / 32768);
  EXPECT_EQ(volts(65535, {1, 100.25F}, 10), 10 + 99.25 * 10 / 32768);
  EXPECT_TRUE(at_rail(0));
  EXPECT_TRUE(at_rail(65535));
  EXPECT_FALSE(at_rail(1));
}

TEST(Usb1608Protocol, EachRangeAndInputHasItsConstants) {
  Calibrations all;
  for (std::size_t i = 0; i < kInputs; ++i)
    all[i] = {1 + 0.001F * static_cast<float>(i), static_cast<float>(i) - 3};
  const std::string memory = calibration_memory(all);
  ASSERT_EQ(memory.size(), 512U);
  for (const Range& range : kRanges)
    for (std::size_t i = 0; i < kInputs; ++i) {
      const auto read =
          read_calibration(memory.substr(calibration_address(range.code, i), kPairBytes));
      ASSERT_TRUE(read);
      EXPECT_EQ(read->slope, all[i].slope);
      EXPECT_EQ(read->offset, all[i].offset);
    }
  EXPECT_EQ(calibration_address(5, 7), 8 * (8 * 5 + 7));
}

TEST(Usb1608Protocol, RefusesImpossibleCalibration) {
  const auto pair = [](float slope, float offset) {
    Calibrations all;
    all[0] = {slope, offset};
    return calibration_memory(all).substr(0, kPairBytes);
  };
  EXPECT_TRUE(read_calibration(pair(0.95F, 200)));
  for (const auto& bad :
       {pair(0, 0), pair(2, 0), pair(-1, 0), pair(1, 10'000), pair(NAN, 0), pair(1, NAN),
        pair(INFINITY, 0), std::string(8, '\xFF'), std::string(7, '\0')})
    EXPECT_FALSE(read_calibration(bad));
}

TEST(Usb1608Protocol, SlopeMayDifferByATenth) {
  const auto slope = [](const char* hex) {
    return read_calibration(bytes(hex) + std::string(4, '\0')).has_value();
  };
  EXPECT_TRUE(slope("5C 8F 8A 3F"));   // 1.0825
  EXPECT_FALSE(slope("33 33 93 3F"));  // 1.15
  EXPECT_FALSE(slope("9A 99 59 3F"));  // 0.85
}

TEST(Usb1608Settings, ScanHasItsInputsAndOptions) {
  Settings settings;
  settings.rate_hz = 1000;
  settings.inputs.resize(2);
  settings.inputs[0].input = 2;
  settings.inputs[1].input = 7;
  EXPECT_EQ(scan_start(scan_setup(settings)), bytes("00 00 00 00 3F 9C 00 00 84 80"));
  // At 100 scans/s, a packet of 64 bytes would take 160 ms to fill. Therefore the device must send
  // each scan immediately.
  settings.rate_hz = 100;
  EXPECT_EQ(scan_start(scan_setup(settings)), bytes("00 00 00 00 7F 1A 06 00 84 81"));
}

// A packet has 64 bytes. A transfer has the packets of 5 ms, and 0.25 s of packets are pending.
// The number of transfers is 4 to 64.
TEST(Usb1608Settings, TransfersHoldAQuarterOfASecond) {
  EXPECT_EQ(transfers_for(400'000).bytes, 62U * 64);  // 12,500 packets per second
  EXPECT_EQ(transfers_for(400'000).transfers, 51U);
  EXPECT_EQ(transfers_for(32'000).bytes, 5U * 64);
  EXPECT_EQ(transfers_for(32'000).transfers, 50U);
  EXPECT_EQ(transfers_for(10).bytes, 64U);
  EXPECT_EQ(transfers_for(10).transfers, 4U);
}

}  // namespace
}  // namespace mdof::drivers::mcc_usb1608fs_plus
