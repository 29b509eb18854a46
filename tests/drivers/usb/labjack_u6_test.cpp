// The driver reads the simulated U6 through the real libusb.
#include "drivers/labjack_u6/labjack_u6.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "drivers/labjack_u6/simulated_labjack_u6.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/usb/bus.h"

namespace mdof::drivers::labjack_u6 {
namespace {

using namespace std::chrono_literals;

constexpr double kRate_Hz = 1000;  // so low that each packet has its own transfer

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// True values of the inputs. AIN0 is the time in s since the start. AIN1 is at the end of its
// range. AIN2 is -1.5 V. The counter counts 1 count/us.
struct Truth {
  std::int64_t zero_ns = monotonic_ns();
  double operator()(std::size_t input, std::int64_t t_ns) const {
    const double age_s = static_cast<double>(t_ns - zero_ns) * 1e-9;
    if (input == SimulatedLabjackU6::kCounterInput) return std::floor(age_s * 1e6);
    return input == 0 ? age_s : input == 1 ? 20 : -1.5;
  }
};

class UsbLabjackU6 : public testing::Test {
 protected:
  void plug(const SimulatedLabjackU6::Faults& faults = {}) {
    device =
        std::make_unique<SimulatedLabjackU6>(truth, SimulatedLabjackU6::Options{.faults = faults});
    number = bus.plug(*device);
  }
  // Replaces the device by a device with these faults.
  void again(const SimulatedLabjackU6::Faults& faults) {
    made.reset();
    bus.unplug(number);
    plug(faults);
  }
  LabjackU6& driver() {
    if (!made) {
      Settings settings;
      settings.name = "daq";
      settings.serial = serial;
      settings.rate_hz = rate_hz;
      settings.inputs = {{{"A", Unit::volt}, 0, 0},
                         {{"B", Unit::volt}, 1, 0},
                         third,
                         {{"encoder", Unit::um}, -1, -0.5, most_counts_per_s}};
      settings.inputs.back().fio = fio;
      made = std::make_unique<LabjackU6>(settings);
    }
    return *made;
  }
  std::string refusal() {
    const Status opened = driver().open();
    return opened ? "opened" : opened.error().message;
  }
  void change(const SimulatedLabjackU6::Faults& faults) {
    bus.change([&] { device->set_faults(faults); });
  }

  Truth truth;
  std::unique_ptr<SimulatedLabjackU6> device;
  std::string serial;
  double rate_hz = kRate_Hz, most_counts_per_s = 0;
  Input third = {{"C", Unit::volt}, 2, 0};
  int fio = 0;  // FIO number of the encoder
  int number = 0;
  usb::Bus bus;
  std::unique_ptr<LabjackU6> made;
};

TEST_F(UsbLabjackU6, GivesVoltsAndMicrometresAtTheirTimes) {
  plug();
  ASSERT_EQ(refusal(), "opened");
  EXPECT_EQ(driver().info().description,
            "LabJack U6 360012345, firmware 1.15, at USB bus 1, device 2");
  EXPECT_EQ(driver().info().rate_hz, kRate_Hz);
  const Collected all = collect(driver(), 500);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.lost, 0U);
  expect_growing(all.time_ns);
  for (std::size_t i = 0; i < all.scans.size(); ++i) {
    const double age_s = static_cast<double>(all.time_ns[i] - truth.zero_ns) * 1e-9;
    ASSERT_NEAR(all.scans[i][0], age_s, 0.3) << i;  // a busy machine reads late
    ASSERT_NEAR(all.scans[i][2], -1.5, 2e-4);
    // The counter is read five slots of 10 us after AIN0. Its zero is the count at the start.
    const double counts = all.scans[i][3] - all.scans[0][3];
    ASSERT_NEAR(counts, -0.5e6 * static_cast<double>(i) / kRate_Hz, 0.6) << i;
    ASSERT_EQ(all.quality[i][0], Quality::good);
    ASSERT_EQ(all.quality[i][1], Quality::over_range);
    ASSERT_EQ(all.quality[i][3], Quality::good);
  }
}

// AIN2 minus AIN3 is 0 V. With the constants of another range the value would be 1 mV.
TEST_F(UsbLabjackU6, InputRangeAndEncoderLinesAreSelectable) {
  third.gain = 3;
  third.differential = true;
  fio = 2;
  plug();
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 100);
  ASSERT_EQ(all.error, "");
  for (const auto& scan : all.scans) ASSERT_NEAR(scan[2], 0, 1e-6);
  EXPECT_LT(all.scans.back()[3], all.scans.front()[3]);
  EXPECT_EQ(all.quality.back()[3], Quality::good);
  ASSERT_EQ(refusal(), "opened");  // the driver opens the device again, and the count continues
  EXPECT_EQ(driver().info().datum_lost, "");
}

// The encoder counts 1,000,000 counts/s.
TEST_F(UsbLabjackU6, CountIsSuspectAfterExceedingItsSpeedLimit) {
  most_counts_per_s = 30'000;
  plug();
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(driver().info().description, ", counts up to 15 mm/s"));
  const Collected all = collect(driver(), 100);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.quality.back()[3], Quality::suspect);
  EXPECT_EQ(all.quality.back()[0], Quality::good);
  EXPECT_TRUE(has(driver().info().datum_lost, "counts may have been lost"));
}

TEST_F(UsbLabjackU6, ReadReturnsAtItsTimeoutWithoutData) {
  SimulatedLabjackU6::Faults faults;
  faults.stop_at = 0;
  faults.stop_error = 0;
  plug(faults);
  ASSERT_EQ(refusal(), "opened");
  SampleBlock block;
  const auto before = std::chrono::steady_clock::now();
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(driver().read(block, 20ms));
  EXPECT_EQ(block.scans(), 0U);
  EXPECT_LT(std::chrono::steady_clock::now() - before, 2s);
}

TEST_F(UsbLabjackU6, SilenceIsAnError) {
  SimulatedLabjackU6::Faults faults;
  faults.stop_at = 0;
  faults.stop_error = 0;
  plug(faults);
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(collect(driver(), 1000).error, "no data for 2 s"));
}

// The last packet arrives, although the transfer is not full.
TEST_F(UsbLabjackU6, FindsTheReasonOfSilence) {
  SimulatedLabjackU6::Faults faults;
  faults.stop_at = 8;
  plug(faults);
  rate_hz = 5000;
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 1000);
  EXPECT_TRUE(has(all.error, "U6 error 55")) << all.error;
  EXPECT_EQ(all.scans.size(), 8 * 25U / 5);
}

TEST_F(UsbLabjackU6, OpensBySerialNumberWithoutDescriptorString) {
  SimulatedLabjackU6::Faults nameless;
  nameless.nameless = true;
  plug(nameless);
  SimulatedLabjackU6 other(truth, {.serial = 360000002, .faults = nameless});
  const int second = bus.plug(other);
  serial = "360000002";
  ASSERT_EQ(refusal(), "opened");
  EXPECT_TRUE(has(driver().info().description, "U6 360000002"));
  made.reset();
  serial = "5";
  EXPECT_TRUE(has(refusal(), "\"360000002\" (USB bus 1, device 3), \"360012345\"")) << refusal();
  EXPECT_TRUE(has(refusal(), "device \"daq\" (LabJack U6 5)")) << refusal();
  bus.unplug(second);
}

TEST_F(UsbLabjackU6, MissingDeviceIsAnError) {
  EXPECT_TRUE(has(refusal(), "no LabJack U6 (0cd5:0006) is on the USB")) << refusal();
  SampleBlock block;
  EXPECT_TRUE(has(driver().read(block, 1ms).error().message, "not open"));
}

TEST_F(UsbLabjackU6, BadChecksumsAreErrors) {
  SimulatedLabjackU6::Faults faults;
  faults.deaf = true;
  plug(faults);
  EXPECT_TRUE(has(refusal(), "B8 B8")) << refusal();
  faults = {};
  faults.wrong_checksum = true;
  change(faults);
  EXPECT_TRUE(has(refusal(), "checksum")) << refusal();
  change({});
  EXPECT_EQ(refusal(), "opened");
}

TEST_F(UsbLabjackU6, DiscardsAStreamThatRunsAtTheStart) {
  SimulatedLabjackU6::Faults faults;
  faults.streaming = true;  // a packet of an earlier stream, with counter 7, is pending
  plug(faults);
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 100);
  EXPECT_EQ(all.error, "");
  EXPECT_EQ(all.scans.size() >= 100, true);
  EXPECT_NEAR(all.scans[0][2], -1.5, 2e-4);
}

TEST_F(UsbLabjackU6, CountsDroppedScansAndKeepsTimes) {
  SimulatedLabjackU6::Faults faults;
  faults.recovery_at = 5;
  faults.dropped = 300;
  plug(faults);
  ASSERT_EQ(refusal(), "opened");
  const Collected all = collect(driver(), 400);
  ASSERT_EQ(all.error, "");
  EXPECT_EQ(all.lost, 300U);
  std::size_t gaps = 0;
  for (std::size_t i = 1; i < all.scans.size(); ++i) {
    const double scans = (all.scans[i][3] - all.scans[i - 1][3]) / -0.5 * 1e-6 * kRate_Hz;
    if (scans < 2) continue;
    ++gaps;
    EXPECT_NEAR(scans, 301, 0.1);
    const auto step_ns = static_cast<double>(all.time_ns[i] - all.time_ns[i - 1]);
    EXPECT_NEAR(step_ns * 1e-9, 301 / kRate_Hz, 0.05);
  }
  EXPECT_EQ(gaps, 1U);
}

TEST_F(UsbLabjackU6, InvalidStreamIsAnErrorAndIsRestarted) {
  struct Case {
    SimulatedLabjackU6::Faults faults;
    const char* says;
  };
  std::vector<Case> cases(5);
  for (Case& c : cases) c.faults.stop_at = 8;
  cases[0].says = "U6 error 55";
  cases[1].faults.stop_error = kRecoveryOverflow;
  cases[1].says = "U6 error 63";
  cases[2].faults = {};
  cases[2].faults.skip_at = 8;
  cases[2].says = "packets are missing";
  cases[3].faults = {};
  cases[3].faults.short_at = 8;
  cases[3].says = "checksum";
  cases[4].faults = {};
  cases[4].faults.unplug_at = 8;
  cases[4].says = "is gone from the USB";
  plug();
  for (const Case& c : cases) {
    again(c.faults);
    ASSERT_EQ(refusal(), "opened");
    const Collected before = collect(driver(), 10'000);
    EXPECT_TRUE(has(before.error, c.says)) << before.error;
    EXPECT_TRUE(has(before.error, "\"daq\"")) << before.error;
    // Eight packets were valid. All their scans were returned, except packets in the same transfer
    // as the fault.
    ASSERT_GT(before.scans.size(), 4 * 25U / 5) << c.says;
    ASSERT_LE(before.scans.size(), 8 * 25U / 5) << c.says;
    if (device->gone()) {
      bus.unplug(number);
      bus.change([&] { device->restart(); });
      number = bus.plug(*device);
    }
    change({});
    ASSERT_EQ(refusal(), "opened");
    const Collected after = collect(driver(), 20);
    ASSERT_EQ(after.error, "");
    // All scans during the interruption count as lost.
    const auto gap_ns = static_cast<double>(after.time_ns.front() - before.time_ns.back());
    EXPECT_NEAR(static_cast<double>(after.lost), gap_ns * 1e-9 * kRate_Hz - 1, 0.6);
  }
}

TEST_F(UsbLabjackU6, CountContinuesAfterABrokenStream) {
  SimulatedLabjackU6::Faults skip;
  skip.skip_at = 8;
  plug(skip);
  ASSERT_EQ(refusal(), "opened");
  const Collected before = collect(driver(), 10'000);
  ASSERT_NE(before.error, "");
  change({});
  ASSERT_EQ(refusal(), "opened");
  const Collected after = collect(driver(), 20);
  EXPECT_EQ(after.quality[0][3], Quality::good);
  const double moved_s = (after.scans[0][3] - before.scans[0][3]) / -0.5e6;
  EXPECT_NEAR(moved_s, after.scans[0][0] - before.scans[0][0], 1e-3);
}

TEST_F(UsbLabjackU6, RestartedCountIsSuspect) {
  SimulatedLabjackU6::Faults unplug;
  unplug.unplug_at = 8;
  plug(unplug);
  ASSERT_EQ(refusal(), "opened");
  EXPECT_EQ(collect(driver(), 10'000).first_quality(0), Quality::good);
  bus.unplug(number);
  EXPECT_TRUE(has(refusal(), "no LabJack U6")) << refusal();
  bus.change([&] { device->restart(); });
  bus.plug(*device);
  ASSERT_EQ(refusal(), "opened");
  const Collected after = collect(driver(), 20);
  EXPECT_EQ(after.quality[0][3], Quality::suspect);
  EXPECT_EQ(after.quality[0][0], Quality::good);
}

TEST_F(UsbLabjackU6, RefusesASecondDriverForOneDevice) {
  plug();
  ASSERT_EQ(refusal(), "opened");
  Settings settings;
  settings.rate_hz = kRate_Hz;
  settings.inputs = {{{"A", Unit::volt}, 0, 0}};
  LabjackU6 second(settings);
  EXPECT_TRUE(has(second.open().error().message, "in use by another program"));
  EXPECT_EQ(collect(driver(), 100).error, "");
}

}  // namespace
}  // namespace mdof::drivers::labjack_u6
