// Checks the highest sampling rates through the real libusb. The value of each input is the number
// of the sample, so a missing sample is detected.
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>

#include "drivers/labjack_u6/labjack_u6.h"
#include "drivers/labjack_u6/simulated_labjack_u6.h"
#include "drivers/mcc_usb1608fs_plus/mcc_usb1608fs_plus.h"
#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"
#include "tests/drivers/usb/bus.h"

namespace mdof::drivers {
namespace {

using std::chrono::milliseconds;

constexpr double kFor_s = 1;

struct Count {
  std::uint64_t scans = 0, lost = 0, wrong = 0;
  std::string error;
  std::int64_t idle_ns = 0;  // longest time in which no transfer was pending
};

// Reads the scans that the device samples in `seconds`, even if they arrive late on a busy
// machine. `wrong(block, scan, k)`: returns true if scan `scan` of the block is not the expected
// scan k of the whole reading.
template <class Wrong>
Count read_for(Driver& driver, double seconds, double rate_hz, const Wrong& wrong) {
  Count count;
  SampleBlock block;
  const double due = seconds * rate_hz;
  while (static_cast<double>(count.scans) < due) {
    const auto state = driver.read(block, milliseconds(20));
    if (!state) {
      count.error = state.error().message;
      return count;
    }
    count.lost += block.lost;
    for (std::size_t i = 0; i < block.scans(); ++i) count.wrong += wrong(block, i, count.scans++);
  }
  return count;
}

void expect_all(const Count& count, double rate_hz) {
  EXPECT_EQ(count.error, "");
  EXPECT_EQ(count.wrong, 0U);
  EXPECT_EQ(count.lost, 0U);
  EXPECT_GE(static_cast<double>(count.scans), rate_hz * kFor_s);
  std::printf(
      "%.0f scans at %.0f Hz, %.0f wrong, %.0f lost; at most %.1f ms without a transfer waiting\n",
      static_cast<double>(count.scans), rate_hz, static_cast<double>(count.wrong),
      static_cast<double>(count.lost), static_cast<double>(count.idle_ns) * 1e-6);
}

// A clock that advances in steps of one scan period. So the number of a scan is exact.
struct ScanClock {
  std::int64_t zero_ns = monotonic_ns();
  std::atomic<std::int64_t> period_ns = 1;
  std::int64_t operator()() const {
    return zero_ns + (monotonic_ns() - zero_ns) / period_ns * period_ns;
  }
  double scan(std::int64_t t_ns) const {
    return std::floor(static_cast<double>(t_ns - zero_ns) / static_cast<double>(period_ns) + 0.1);
  }
};

// --- LabJack U6: its counter is the number of the scan ------------------------------

class UsbU6Rates : public testing::Test {
 protected:
  Count run(std::size_t ains, bool counter, const labjack_u6::SimulatedLabjackU6::Faults& faults) {
    using namespace labjack_u6;
    Settings settings;
    settings.name = "daq";
    for (std::size_t i = 0; i < ains; ++i)
      settings.inputs.push_back(
          {{std::string(1, static_cast<char>('A' + i)), Unit::volt}, static_cast<int>(i), 0});
    if (counter) settings.inputs.push_back({{"encoder", Unit::um}, -1, 1});
    const std::size_t words = ains + (counter ? 2 : 0);
    settings.rate_hz = std::floor(50'000.0 / static_cast<double>(words));
    rate_hz_ = stream_clock(settings.rate_hz)->rate_hz;
    clock.period_ns = std::llround(1e9 / rate_hz_);
    // AIN0 increases by one code per scan and begins in the middle of its range.
    const AinCalibration c = SimulatedLabjackU6::calibration(0);
    device = std::make_unique<SimulatedLabjackU6>(
        [this, c](std::size_t input, std::int64_t t_ns) {
          const double scan = clock.scan(t_ns);
          if (input == SimulatedLabjackU6::kCounterInput) return scan;
          return labjack::volts(c, static_cast<std::uint16_t>(40'000 + std::fmod(scan, 10'000)));
        },
        SimulatedLabjackU6::Options{.faults = faults});
    number = bus.plug(*device);
    made = std::make_unique<LabjackU6>(settings);
    const Status opened = made->open();
    EXPECT_TRUE(opened) << opened.error().message;
    double first = 0, last = 0;
    const std::size_t at = counter ? ains : 0;
    Count count = read_for(
        *made, kFor_s, rate_hz_, [&](const SampleBlock& block, std::size_t i, std::uint64_t k) {
          const double value = counter
                                   ? block.value[at][i]
                                   : std::round(block.value[0][i] / c.positive_slope + c.centre);
          if (k == 0) first = value;
          const double step = k == 0 ? 1 : value - last;
          last = value;
          return counter ? value != first + static_cast<double>(k) : step != 1 && step != -9999;
        });
    count.idle_ns = bus.longest_idle_ns(number, kStreamIn);
    return count;
  }

  ScanClock clock;
  std::unique_ptr<labjack_u6::SimulatedLabjackU6> device;
  double rate_hz_ = 0;
  int number = 0;
  usb::Bus bus{[this] { return clock(); }};
  std::unique_ptr<labjack_u6::LabjackU6> made;
};

TEST_F(UsbU6Rates, FiveInputsAndTheEncoderLoseNoScan) {
  const Count count = run(5, true, {});
  expect_all(count, rate_hz_);
}

TEST_F(UsbU6Rates, OneInputAt50kHzLosesNoScan) {
  const Count count = run(1, false, {});
  expect_all(count, rate_hz_);
  EXPECT_EQ(rate_hz_, 50'000);
}

// Control: if a packet is missing, the driver reports an error.
TEST_F(UsbU6Rates, DetectsAMissingPacket) {
  labjack_u6::SimulatedLabjackU6::Faults faults;
  faults.skip_at = 300;
  EXPECT_NE(run(5, true, faults).error.find("packets are missing"), std::string::npos);
}

// --- USB-1608FS-Plus: the code of an input is the number of its sample --------------------

class Usb1608Rates : public testing::Test {
 protected:
  // So small that no code is at the end of the range.
  static constexpr std::uint64_t kCodes = 65'000;

  Count run(std::size_t inputs, double rate_hz,
            const mcc_usb1608fs_plus::SimulatedMccUsb1608fsPlus::Faults& faults,
            double seconds = kFor_s) {
    using namespace mcc_usb1608fs_plus;
    Settings settings;
    settings.name = "daq";
    settings.rate_hz = rate_hz;
    clock.period_ns = std::llround(1e9 / rate_hz);
    for (std::size_t i = 0; i < inputs; ++i)
      settings.inputs.push_back({{std::string(1, static_cast<char>('A' + i)), Unit::volt}, i});
    device = std::make_unique<SimulatedMccUsb1608fsPlus>(
        [this, inputs](std::size_t input, std::int64_t t_ns) {
          const auto scan = static_cast<std::uint64_t>(clock.scan(t_ns));
          return volts(static_cast<std::uint16_t>(1 + (scan * inputs + input) % kCodes), {}, 10);
        },
        SimulatedMccUsb1608fsPlus::Options{.faults = faults});
    number = bus.plug(*device);
    made = std::make_unique<MccUsb1608fsPlus>(settings);
    const Status opened = made->open();
    EXPECT_TRUE(opened) << opened.error().message;
    std::uint64_t expected = 0;
    Count count = read_for(
        *made, seconds, rate_hz, [&](const SampleBlock& block, std::size_t i, std::uint64_t k) {
          bool wrong = false;
          for (std::size_t c = 0; c < inputs; ++c) {
            const auto code =
                static_cast<std::uint64_t>(std::lround(block.value[c][i] / 10 * 32768 + 32768) - 1);
            if (k == 0 && c == 0) expected = code;
            wrong = wrong || code != expected;
            expected = (code + 1) % kCodes;
          }
          return wrong;
        });
    count.idle_ns = bus.longest_idle_ns(number, kSamplesIn);
    return count;
  }

  ScanClock clock;
  std::unique_ptr<mcc_usb1608fs_plus::SimulatedMccUsb1608fsPlus> device;
  int number = 0;
  usb::Bus bus{[this] { return clock(); }};
  std::unique_ptr<mcc_usb1608fs_plus::MccUsb1608fsPlus> made;
};

TEST_F(Usb1608Rates, FourInputsAt100kHzLoseNoScan) {
  expect_all(run(4, 100'000, {}), 100'000);
}

TEST_F(Usb1608Rates, FiveInputsAt80kHzLoseNoScan) {
  expect_all(run(5, 80'000, {}), 80'000);
}

// Control: the host sleeps so long that all pending transfers end. The test must detect this.
TEST_F(Usb1608Rates, DetectsAHostThatSleeps) {
  run(4, 100'000, {}, 0.2);
  std::this_thread::sleep_for(milliseconds(600));
  SampleBlock block;
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(made->read(block, milliseconds(0)));
  EXPECT_GT(bus.longest_idle_ns(number, mcc_usb1608fs_plus::kSamplesIn), 100'000'000);
}

// Control: one of 24,000 scans is missing and was not reported. The test must detect this.
TEST_F(Usb1608Rates, DetectsAMissingScan) {
  mcc_usb1608fs_plus::SimulatedMccUsb1608fsPlus::Faults faults;
  faults.drop_at = 10'000;
  const Count count = run(5, 80'000, faults, 0.3);
  EXPECT_EQ(count.error, "");
  EXPECT_EQ(count.wrong, 1U);
}

}  // namespace
}  // namespace mdof::drivers
