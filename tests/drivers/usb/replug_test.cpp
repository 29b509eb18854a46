// Unplugs and replugs a device many times during a stream. The driver must open the device each
// time, and no resources may be lost. MDOF_USB_REPLUGS=1000 gives the long test.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>

#include "drivers/labjack_u6/labjack_u6.h"
#include "drivers/labjack_u6/simulated_labjack_u6.h"
#include "drivers/mcc_usb1608fs_plus/mcc_usb1608fs_plus.h"
#include "drivers/mcc_usb1608fs_plus/simulated_mcc_usb1608fs_plus.h"
#include "tests/drivers/usb/bus.h"
#include "tests/drivers/usb/counts.h"

namespace mdof::drivers {
namespace {

using namespace std::chrono_literals;
using std::chrono::steady_clock;

#ifdef MDOF_SANITIZED  // sanitizers keep freed memory, and a file to their symbolizer stays open
constexpr bool kSanitized = true;
constexpr int kSymbolizerDescriptors = 2;
#else
constexpr bool kSanitized = false;
constexpr int kSymbolizerDescriptors = 0;
#endif
constexpr double kMostReopen_s = 1;
constexpr std::int64_t kMostGrowth_bytes = 1 << 20;

double sense(std::size_t input, std::int64_t /*t_ns*/) {
  return input == 0 ? 1 : 2;
}

// Opens the driver, with pauses between the attempts as in mdofd. Returns the time since
// `since_ns`.
double reopen_s(Driver& driver, std::int64_t since_ns) {
  const auto until = steady_clock::now() + 5s;
  while (!driver.open() && steady_clock::now() < until) std::this_thread::sleep_for(10ms);
  return static_cast<double>(monotonic_ns() - since_ns) * 1e-9;
}

// Reads until scans arrive or the driver has failed. Returns the error, or "".
std::string read_some(Driver& driver) {
  SampleBlock block;
  const auto until = steady_clock::now() + 5s;
  while (steady_clock::now() < until) {
    const auto state = driver.read(block, 20ms);
    if (!state) return state.error().message;
    if (block.scans() > 0) return "";
  }
  return "no scans";
}

std::string read_until_error(Driver& driver) {
  std::string error;
  const auto until = steady_clock::now() + 5s;
  while (error.empty() && steady_clock::now() < until) error = read_some(driver);
  return error;
}

struct Found {
  std::vector<double> reopen_s;
  int failures = 0;
  int descriptors = 0;  // increase since the first tenth of the rounds
  std::int64_t growth_bytes = 0;
};

// Calls `each` after each time that the device was unplugged.
template <class Device>
Found replug(Driver& driver, Device& device, int times, const std::function<void()>& each) {
  usb::Bus bus;
  Found found;
  int descriptors = 0;
  std::int64_t resident = 0;
  const int warm = std::max(1, times / 10);
  for (int i = 0; i <= times; ++i) {
    const std::int64_t since_ns = monotonic_ns();
    const int number = bus.plug(device);
    found.reopen_s.push_back(reopen_s(driver, since_ns));
    found.failures += !read_some(driver).empty();
    if (i == warm) descriptors = usb::open_descriptors(), resident = usb::resident_bytes();
    if (i == times) {
      found.descriptors = usb::open_descriptors() - descriptors;
      found.growth_bytes = usb::resident_bytes() - resident;
    }
    bus.unplug(number);
    found.failures += read_until_error(driver).find("is gone from the USB") == std::string::npos;
    device.restart();
    each();
  }
  found.failures += driver.open().has_value();  // closes the device before the bus is destroyed
  std::sort(found.reopen_s.begin(), found.reopen_s.end());
  return found;
}

double p99_of(const Found& found) {
  return found.reopen_s[(found.reopen_s.size() - 1) * 99 / 100];
}

void expect_sound(const Found& found) {
  std::printf(
      "%zu times: opened again in %.0f ms (median), %.0f ms (99 %%), %.0f ms (most); %d "
      "descriptors and %lld KiB more\n",
      found.reopen_s.size(), 1e3 * found.reopen_s[found.reopen_s.size() / 2], 1e3 * p99_of(found),
      1e3 * found.reopen_s.back(), found.descriptors,
      static_cast<long long>(found.growth_bytes / 1024));
  EXPECT_EQ(found.failures, 0);
  EXPECT_LE(p99_of(found), kMostReopen_s);
  EXPECT_LE(found.descriptors, kSymbolizerDescriptors);
  EXPECT_TRUE(kSanitized || found.growth_bytes <= kMostGrowth_bytes) << found.growth_bytes;
}

std::unique_ptr<Driver> labjack_u6_driver() {
  labjack_u6::Settings settings;
  settings.name = "daq";
  settings.inputs = {{{"A", Unit::volt}, 0, 0}, {{"encoder", Unit::um}, -1, 1}};
  return std::make_unique<labjack_u6::LabjackU6>(settings);
}

TEST(UsbReplug, ReplugsOfLabjackU6LeakNoResources) {
  labjack_u6::SimulatedLabjackU6 device(sense, {});
  const auto driver = labjack_u6_driver();
  expect_sound(replug(*driver, device, usb::replugs(), [] {}));
}

TEST(UsbReplug, ReplugsOfMccUsb1608fsPlusLeakNoResources) {
  mcc_usb1608fs_plus::SimulatedMccUsb1608fsPlus device(sense, {});
  mcc_usb1608fs_plus::Settings settings;
  settings.name = "daq";
  settings.rate_hz = 10'000;
  settings.inputs = {{{"A", Unit::volt}, 0}, {{"B", Unit::volt}, 1}};
  mcc_usb1608fs_plus::MccUsb1608fsPlus driver(settings);
  expect_sound(replug(driver, device, usb::replugs(), [] {}));
}

// Control: each round loses a descriptor and 64 KiB of memory, or the device does not return. The
// test must detect this.
TEST(UsbReplug, DetectsLostResourcesAndDevices) {
  labjack_u6::SimulatedLabjackU6 device(sense, {});
  const auto driver = labjack_u6_driver();
  std::vector<int> lost;
  std::vector<std::string> kept;
  const Found found = replug(*driver, device, 20, [&] {
    lost.push_back(::dup(0));
    kept.emplace_back(64 << 10, 'x');
  });
  for (const int fd : lost) ::close(fd);
  EXPECT_GE(found.descriptors, 18);
  EXPECT_LE(found.descriptors, 18 + kSymbolizerDescriptors);
  EXPECT_GT(found.growth_bytes, kMostGrowth_bytes);
  EXPECT_NE(read_some(*driver), "");
}

}  // namespace
}  // namespace mdof::drivers
