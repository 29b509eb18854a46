// The driver reads the simulated USB-1608FS-Plus through the real libusb.
#include "drivers/mcc_usb1608fs_plus/mcc_usb1608fs_plus.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/usb/bus.h"

namespace mdof::drivers::mcc_usb1608fs_plus {
namespace {

using namespace std::chrono_literals;

constexpr double kRate_Hz = 2000;

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// True values of the inputs. CH0 is the time in s since the start. CH1 is outside of its range.
// CH4 is -1.5 V.
struct Truth {
  std::int64_t zero_ns = monotonic_ns();
  double operator()(std::size_t input, std::int64_t t_ns) const {
    if (input == 0) return static_cast<double>(t_ns - zero_ns) * 1e-9;
    return input == 1 ? 20 : -1.5;
  }
};

// Each input has other constants, so that a test detects the use of wrong constants.
Calibrations odd() {
  Calibrations all;
  for (std::size_t i = 0; i < kInputs; ++i)
    all[i] = {0.95F + 0.01F * static_cast<float>(i), 100 - 30 * static_cast<float>(i)};
  return all;
}

class Usb1608 : public testing::Test {
 protected:
  void plug(const SimulatedMccUsb1608fsPlus::Faults& faults = {}) {
    device = std::make_unique<SimulatedMccUsb1608fsPlus>(
        truth, SimulatedMccUsb1608fsPlus::Options{.calibrations = odd(), .faults = faults});
    number = bus.plug(*device);
  }
  MccUsb1608fsPlus& driver() {
    if (!made) {
      settings.name = "daq";
      settings.inputs = {{{"E", Unit::volt}, 4}, {{"A", Unit::volt}, 0}, {{"B", Unit::volt}, 1}};
      made = std::make_unique<MccUsb1608fsPlus>(settings);
    }
    return *made;
  }
  std::string refusal() {
    const Status opened = driver().open();
    return opened ? "opened" : opened.error().message;
  }
  void change(const SimulatedMccUsb1608fsPlus::Faults& faults) {
    bus.change([&] { device->set_faults(faults); });
  }
  // Checks that all returned scans are valid. The value of CH0 is the true time of a scan.
  void expect_sound(const Collected& all) {
    expect_growing(all.time_ns);
    for (std::size_t i = 1; i < all.scans.size(); ++i)
      ASSERT_NEAR(all.scans[i][1] - all.scans[0][1], static_cast<double>(i) / settings.rate_hz,
                  7e-4)
          << i;
  }

  Truth truth;
  std::unique_ptr<SimulatedMccUsb1608fsPlus> device;
  Settings settings{"daq", "", kRate_Hz, kRanges.front(), {}};
  int number = 0;
  usb::Bus bus;
  std::unique_ptr<MccUsb1608fsPlus> made;
};

TEST_F(Usb1608, GivesCalibratedVoltsAtTheirTimes) {
  plug();
  ASSERT_EQ(refusal(), "opened");
  EXPECT_EQ(driver().info().description, "MCC USB-1608FS-Plus 01A2B3C4, at USB bus 1, device 2");
  EXPECT_EQ(driver().info().rate_hz, kRate_Hz);
  const Collected all = collect(driver(), 1000);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.lost, 0U);
  expect_sound(all);
  for (std::size_t i = 0; i < all.scans.size(); ++i) {
    const double age_s = static_cast<double>(all.time_ns[i] - truth.zero_ns) * 1e-9;
    ASSERT_NEAR(all.scans[i][0], -1.5, 4e-4);
    ASSERT_NEAR(all.scans[i][1], age_s, 0.3) << i;  // a busy machine reads late
    ASSERT_EQ(all.quality[i][1], Quality::good);
    ASSERT_EQ(all.quality[i][2], Quality::over_range);
  }
}

TEST_F(Usb1608, SlowScansAreSentImmediately) {
  settings.rate_hz = 50;
  plug();
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 10);
  EXPECT_EQ(all.error, "");
  expect_sound(all);
}

TEST_F(Usb1608, ReadKeepsItsTimeoutAndSilenceIsAnError) {
  SimulatedMccUsb1608fsPlus::Faults faults;
  faults.silent_at = 0;
  plug(faults);
  ASSERT_EQ(refusal(), "opened");
  SampleBlock block;
  const auto before = std::chrono::steady_clock::now();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(driver().read(block, 20ms));
  EXPECT_EQ(block.scans(), 0U);
  EXPECT_LT(std::chrono::steady_clock::now() - before, 1s);
  EXPECT_TRUE(has(collect(driver(), 10).error, "no data for 2 s"));
}

TEST_F(Usb1608, OverrunIsAnErrorWithoutLaterScans) {
  for (const bool stalls : {false, true}) {
    made.reset();
    if (number) bus.unplug(number);
    plug();
    ASSERT_EQ(refusal(), "opened");
    const Collected before = collect(driver(), 200);
    ASSERT_EQ(before.error, "");
    SimulatedMccUsb1608fsPlus::Faults faults;
    faults.overrun_at = 0;
    faults.overrun = 300;
    faults.stalls = stalls;
    change(faults);
    Collected rest = collect(driver(), 100'000);
    EXPECT_TRUE(has(rest.error, "the FIFO of the device has overflowed")) << rest.error;
    EXPECT_TRUE(has(rest.error, "device \"daq\"")) << rest.error;
    rest.time_ns.insert(rest.time_ns.begin(), before.time_ns.begin(), before.time_ns.end());
    rest.scans.insert(rest.scans.begin(), before.scans.begin(), before.scans.end());
    expect_sound(rest);
    change({});
    ASSERT_EQ(refusal(), "opened");
    const Collected after = collect(driver(), 100);
    EXPECT_EQ(after.error, "");
    expect_sound(after);
    // All scans that were not returned count as lost.
    const auto gap_ns = static_cast<double>(after.time_ns.front() - rest.time_ns.back());
    EXPECT_NEAR(static_cast<double>(after.lost), gap_ns * 1e-9 * kRate_Hz - 1, 0.6);
  }
}

// Checks that expect_sound() detects a scan that is missing and was not reported.
TEST_F(Usb1608, DetectsAMissingScan) {
  SimulatedMccUsb1608fsPlus::Faults faults;
  faults.drop_at = 50;
  plug(faults);
  settings.rate_hz = 500;  // in one scan period, CH0 increases by six codes
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 150);
  ASSERT_EQ(all.error, "");
  const double last_s = all.scans.back()[1] - all.scans.front()[1];
  EXPECT_NEAR(last_s * settings.rate_hz, static_cast<double>(all.scans.size()), 0.5);
}

TEST_F(Usb1608, JoinsShortPackets) {
  for (const std::size_t size : {1U, 7U, 50U}) {
    SimulatedMccUsb1608fsPlus::Faults faults;
    faults.short_packets = size;
    made.reset();
    if (number) bus.unplug(number);
    plug(faults);
    settings.rate_hz = 500;
    ASSERT_EQ(refusal(), "opened");
    const Collected all = collect(driver(), 60);
    ASSERT_EQ(all.error, "") << size;
    expect_sound(all);
  }
}

TEST_F(Usb1608, DiscardsAScanThatRunsAtTheStart) {
  SimulatedMccUsb1608fsPlus::Faults faults;
  faults.running = true;
  plug(faults);
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 200);
  EXPECT_EQ(all.error, "");
  expect_sound(all);
}

TEST_F(Usb1608, ScanStoppedByAnotherProgramIsAnError) {
  plug();
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(collect(driver(), 50).error, "");
  bus.change([&] { device->control({0x40, kScanStop, 0, 0, 0}, "", monotonic_ns()); });
  EXPECT_TRUE(has(collect(driver(), 100'000).error, "the scan has stopped"));
}

TEST_F(Usb1608, RefusesImpossibleCalibration) {
  for (const float slope : {0.0F, 2.0F, std::numeric_limits<float>::quiet_NaN()}) {
    made.reset();
    if (number) bus.unplug(number);
    plug();
    Calibrations bad = odd();
    bad[1].slope = slope;
    device->set_memory(calibration_memory(bad));
    EXPECT_TRUE(has(refusal(), "CH1: the constants in the calibration memory are impossible"))
        << refusal();
    bad[1].slope = 1;
    bad[2].slope = slope;  // this input is not used
    bus.change([&] { device->set_memory(calibration_memory(bad)); });
    EXPECT_EQ(refusal(), "opened");
  }
}

TEST_F(Usb1608, UnplugIsAnErrorAndTheDeviceIsFoundAgain) {
  plug();
  ASSERT_EQ(refusal(), "opened");
  ASSERT_EQ(collect(driver(), 100).error, "");
  SimulatedMccUsb1608fsPlus::Faults faults;
  faults.unplug_at = 0;
  change(faults);
  const Collected before = collect(driver(), 100'000);
  EXPECT_TRUE(has(before.error, "is gone from the USB")) << before.error;
  expect_sound(before);
  bus.unplug(number);
  EXPECT_TRUE(has(refusal(), "no MCC USB-1608FS-Plus (09db:00ea)")) << refusal();
  bus.change([&] { device->restart(); });
  bus.plug(*device);
  ASSERT_EQ(refusal(), "opened");
  const Collected after = collect(driver(), 100);
  EXPECT_EQ(after.error, "");
  EXPECT_GT(after.lost, 0U);
}

TEST_F(Usb1608, RefusesAnotherSerialNumber) {
  plug();
  settings.serial = "01FFFFFF";
  EXPECT_TRUE(has(refusal(), "is on the USB; found: \"01A2B3C4\"")) << refusal();
}

}  // namespace
}  // namespace mdof::drivers::mcc_usb1608fs_plus
