// The simulated USB-1608FS-Plus, called without USB.
#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"

#include <gtest/gtest.h>

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

using usb::Answer;

constexpr std::int64_t kMs = 1'000'000;

double volts_of_input(std::size_t input, std::int64_t /*t_ns*/) {
  return static_cast<double>(input);
}

class Usb1608Device : public testing::Test {
 protected:
  usb::Reply report(std::uint8_t request, const std::string& bytes = "") {
    return device.control({0x40, request, 0, 0, static_cast<std::uint16_t>(bytes.size())}, bytes,
                          now);
  }
  std::string ask(std::uint8_t request, std::uint16_t value, std::uint16_t length) {
    return device.control({0xC0, request, value, 0, length}, "", now).bytes;
  }
  DeviceStatus status() { return read_status(ask(kStatus, 0, 2)).value(); }
  usb::Reply start(std::uint8_t options, double rate_hz = 1000) {
    return report(kScanStart, scan_start({0, pacer_period(rate_hz), 0x05, options}));
  }

  SimulatedMccUsb1608fsPlus device{volts_of_input, {}};
  std::int64_t now = 0;
};

TEST_F(Usb1608Device, SamplesTheInputsOfItsMask) {
  EXPECT_EQ(ask(kSerial, 0, 8), "01A2B3C4");
  ASSERT_EQ(report(kConfig, config(0)).answer, Answer::done);
  ASSERT_EQ(start(kNoStall).answer, Answer::done);
  EXPECT_TRUE(status().running);
  now = 15 * kMs;
  EXPECT_EQ(device.in(kSamplesIn, 64, now).answer, Answer::not_yet);
  now = 17 * kMs;
  ScanSplitter line(2);
  std::vector<std::uint16_t> words;
  line.take(device.in(kSamplesIn, 64, now).bytes, words);
  ASSERT_EQ(words.size(), 32U);
  EXPECT_EQ(words[0], 32768);
  EXPECT_NEAR(volts(words[1], {}, 10), 2, 4e-4);
}

TEST_F(Usb1608Device, StartWhileRunningStalls) {
  ASSERT_EQ(start(kNoStall).answer, Answer::done);
  EXPECT_EQ(start(kNoStall).answer, Answer::stall);
  EXPECT_EQ(report(kScanStop).answer, Answer::done);
  EXPECT_EQ(start(kNoStall).answer, Answer::done);
  EXPECT_EQ(report(kScanStart, "short").answer, Answer::stall);
  EXPECT_EQ(report(0x99).answer, Answer::stall);
}

TEST_F(Usb1608Device, OverrunStallsUnlessDisabled) {
  SimulatedMccUsb1608fsPlus::Faults faults;
  faults.overrun_at = 20;
  device.set_faults(faults);
  ASSERT_EQ(start(0).answer, Answer::done);
  now = 30 * kMs;
  EXPECT_EQ(device.in(kSamplesIn, 64, now).answer, Answer::done);
  EXPECT_EQ(device.in(kSamplesIn, 64, now).answer, Answer::stall);
  EXPECT_TRUE(status().overrun);
  device.clear_halt(kSamplesIn);
  report(kScanStop);
  report(kClearFifo);
  ASSERT_EQ(start(kNoStall).answer, Answer::done);
  EXPECT_FALSE(status().overrun);
  now += 60 * kMs;
  EXPECT_EQ(device.in(kSamplesIn, 64, now).answer, Answer::done);
  EXPECT_EQ(device.in(kSamplesIn, 64, now).answer, Answer::not_yet);
  EXPECT_TRUE(status().overrun);
}

TEST_F(Usb1608Device, ImmediateTransfersDoNotWait) {
  ASSERT_EQ(start(kNoStall | kImmediate, 10).answer, Answer::done);
  now = 100 * kMs;
  EXPECT_EQ(device.in(kSamplesIn, 64, now).bytes.size(), 4U);
  EXPECT_EQ(device.in(kSamplesIn, 64, now).answer, Answer::not_yet);
}

TEST_F(Usb1608Device, UnplugsAtItsScan) {
  SimulatedMccUsb1608fsPlus::Faults faults;
  faults.unplug_at = 3;
  device.set_faults(faults);
  start(kNoStall);
  now = 20 * kMs;
  device.in(kSamplesIn, 64, now);
  EXPECT_TRUE(device.gone());
  device.restart();
  EXPECT_FALSE(device.gone());
  EXPECT_FALSE(status().running);
}

}  // namespace
}  // namespace mdof::drivers::mcc_usb1608fs_plus
