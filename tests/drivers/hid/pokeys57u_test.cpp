// The PoKeys driver uses the real hidapi with the simulated bus of umockdev.
#include "drivers/pokeys57u/pokeys57u.h"

#include <fcntl.h>
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <thread>

#include "drivers/pokeys57u/simulated_pokeys57u.h"
#include "tests/drivers/collect.h"
#include "tests/drivers/hid/hid_bus.h"

namespace mdof::drivers::pokeys57u {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;

// The count of an encoder is the time in milliseconds. So each value shows when it was read.
double milliseconds_now(std::size_t, std::int64_t t_ns) {
  return static_cast<double>(t_ns % 1'000'000'000'000) * 1e-6;
}
double still(std::size_t input, std::int64_t) {
  return input < kCounters ? 1000.0 + static_cast<double>(input)
                           : 0.55 * static_cast<double>(input - kCounters);
}

Input input(const char* id, Unit unit, std::size_t index) {
  Input made;
  made.channel = {id, unit};
  made.name = "encoder" + std::to_string(index + 1);
  made.index = index;
  made.um_per_count = 0.5;
  made.most_counts_per_s = 1e5;
  return made;
}
Input counter(std::size_t index) {
  return input("encoder", Unit::um, index);
}
Settings settings_of(std::vector<Input> inputs = {counter(0)}) {
  Settings settings;
  settings.name = "slide";
  settings.response_timeout = milliseconds(200);
  settings.slow = milliseconds(200);  // this machine may be slow
  settings.inputs = std::move(inputs);
  return settings;
}

class PoKeys57uOnHid : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(under_umockdev()) << "run it under umockdev-wrapper";
    bus.emplace();
  }
  void expect_error(Settings settings, const std::string& part) {
    const Status opened = PoKeys57u(std::move(settings)).open();
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().message.find(part), std::string::npos) << opened.error().message;
    EXPECT_NE(opened.error().message.find("\"slide\""), std::string::npos);
  }
  // Checks that each good value was true at a time between its request and its reply, with a
  // tolerance of 200 ms.
  static void expect_true_values(const Collected& all) {
    std::size_t good = 0;
    for (std::size_t i = 0; i < all.scans.size(); ++i) {
      if (all.first_quality(i) != Quality::good) continue;
      ++good;
      EXPECT_NEAR(all.scans[i][0] / 0.5, milliseconds_now(0, all.time_ns[i]), 101) << i;
    }
    EXPECT_GE(good, all.scans.size() / 2);
  }
  void run_with(const SimulatedPokeys57u::Faults& faults, std::size_t scans = 30) {
    device.set_faults({});
    ASSERT_NO_FATAL_FAILURE(bus->plug(0, device));
    const Status opened = driver.open();
    ASSERT_TRUE(opened) << opened.error().message;
    bus->change([&] { device.set_faults(faults); });
    got = collect(driver, scans);
  }

  SimulatedPokeys57u device{milliseconds_now, {}};
  PoKeys57u driver{settings_of()};
  Collected got;
  std::optional<HidBus> bus;  // must be destroyed first
};

TEST_F(PoKeys57uOnHid, GivesValuesAtTheirTimes) {
  run_with({}, 100);
  EXPECT_EQ(got.error, "");
  EXPECT_EQ(got.lost, 0u);
  EXPECT_EQ(driver.rejected(), 0u);
  expect_growing(got.time_ns);
  expect_true_values(got);
  const DeviceInfo info = driver.info();
  EXPECT_EQ(info.description, "PoLabs PoKeys57U 12345, firmware 4.2.19, at /dev/hidraw0");
  EXPECT_EQ(info.rate_hz, 500);
}

TEST_F(PoKeys57uOnHid, IgnoresTheReplyToAnotherRequest) {
  run_with({.wrong_id_at = 5});
  EXPECT_EQ(got.error, "");
  EXPECT_EQ(got.lost, 0u);
  EXPECT_GE(driver.rejected(), 1u);
  expect_true_values(got);
}

TEST_F(PoKeys57uOnHid, RepeatsTheRequestAfterAWrongChecksum) {
  run_with({.bad_checksum_at = 5});
  EXPECT_EQ(got.error, "");
  EXPECT_EQ(got.lost, 0u);
  EXPECT_GE(driver.rejected(), 1u);
  expect_true_values(got);
}

TEST_F(PoKeys57uOnHid, ThreeWrongChecksumsLoseAScan) {
  run_with({.bad_checksum_at = 5, .bad_checksums = 3});
  EXPECT_EQ(got.error, "");
  EXPECT_GE(got.lost, 1u);
  EXPECT_GE(driver.rejected(), 3u);
  expect_true_values(got);
}

TEST_F(PoKeys57uOnHid, IgnoresATruncatedReply) {
  run_with({.short_at = 5});
  EXPECT_EQ(got.error, "");
  EXPECT_GE(driver.rejected(), 1u);
  expect_true_values(got);
}

// The late reply has a count from 450 ms before.
TEST_F(PoKeys57uOnHid, LateReplyIsNeverUsedForAnother) {
  run_with({.late_at = 5, .late_ns = 450'000'000}, 200);
  EXPECT_EQ(got.error, "");
  EXPECT_GE(driver.rejected(), 1u);
  expect_true_values(got);
}

TEST_F(PoKeys57uOnHid, MissingReplyIsRequestedAgainThenLost) {
  run_with({.first_unanswered = 5, .unanswered_requests = 2});
  EXPECT_EQ(got.error, "");
  EXPECT_EQ(got.lost, 0u);
  EXPECT_GE(device.requests(), 30 + 2 + 3);  // 30 polls, 2 repeated requests, 3 requests at opening
  bus->change([&] { device.set_faults({.first_unanswered = 5, .unanswered_requests = 3}); });
  got = collect(driver, 30);
  EXPECT_EQ(got.error, "");
  EXPECT_GE(got.lost, 1u);
  expect_true_values(got);
}

TEST_F(PoKeys57uOnHid, SilenceIsAnError) {
  Settings settings = settings_of();
  settings.silence = milliseconds(100);
  PoKeys57u patient(settings);
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, device));
  ASSERT_TRUE(patient.open());
  bus->change(
      [&] { device.set_faults({.first_unanswered = 3, .unanswered_requests = 1'000'000}); });
  got = collect(patient, 1000);
  EXPECT_NE(got.error.find("no valid reply for 100 ms"), std::string::npos) << got.error;
  bus->change([&] { device.set_faults({}); });
  ASSERT_TRUE(patient.open());
  EXPECT_EQ(collect(patient, 5).first_quality(4), Quality::good) << "it had its power all the time";
}

TEST_F(PoKeys57uOnHid, CountContinuesOverTheEndOf32Bits) {
  double calls = 0;  // increases by one when an encoder is read
  SimulatedPokeys57u wrapping([&](std::size_t, std::int64_t) { return calls += 1; },
                              {.count_offset = (std::int64_t{1} << 31) - 1000});
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, wrapping));
  ASSERT_TRUE(driver.open());
  got = collect(driver, 150);
  EXPECT_EQ(got.error, "");
  ASSERT_EQ(got.scans.size(), 150u);
  EXPECT_LT(got.scans.front()[0], 0.5 * 2147483648.0);
  EXPECT_GT(got.scans.back()[0], 0.5 * 2147483648.0);
  for (std::size_t i = 1; i < got.scans.size(); ++i) {
    EXPECT_GE(got.scans[i][0], got.scans[i - 1][0]);
    EXPECT_EQ(got.first_quality(i), Quality::good);
  }
  bus.reset();
}

TEST_F(PoKeys57uOnHid, IndexThatSetsTheCountToZeroMakesItSuspect) {
  SimulatedPokeys57u far(milliseconds_now, {.count_offset = 10'000'000});
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, far));
  ASSERT_TRUE(driver.open());
  bus->change([&] { far.set_faults({.index_at = 5}); });
  got = collect(driver, 20);
  EXPECT_EQ(got.error, "");
  EXPECT_EQ(got.first_quality(4), Quality::good);
  EXPECT_EQ(got.first_quality(5), Quality::suspect);
  EXPECT_EQ(got.first_quality(19), Quality::suspect);
  EXPECT_NE(driver.info().datum_lost.find("encoder1 jumped by -"), std::string::npos);
  bus.reset();
}

TEST_F(PoKeys57uOnHid, LostPowerMakesCountsSuspectOverReopens) {
  run_with({.restart_at = 5}, 10);
  ASSERT_TRUE(driver.open());
  got = collect(driver, 5);
  EXPECT_EQ(got.first_quality(4), Quality::suspect);
  EXPECT_NE(driver.info().datum_lost.find("lost power"), std::string::npos);
}

// The tick is a number of milliseconds with 32 bits. It wraps after 49.7 days, and half of its
// range is 24.9 days. The count is 0 before and after the loss of power, so only the tick can show
// the restart.
TEST_F(PoKeys57uOnHid, DetectsLostPowerAfterAnyUptime) {
  for (const std::int64_t days : {1, 20, 27, 45}) {
    SimulatedPokeys57u old(still, {.uptime_ms = days * 86'400'000, .count_offset = -1000});
    ASSERT_NO_FATAL_FAILURE(bus->plug(0, old));
    PoKeys57u reader(settings_of());
    ASSERT_TRUE(reader.open());
    got = collect(reader, 5);
    EXPECT_EQ(got.first_quality(4), Quality::good) << days;
    bus->change([&] { old.set_faults({.restart_at = 0}); });
    ASSERT_TRUE(reader.open());
    got = collect(reader, 5);
    EXPECT_EQ(got.first_quality(4), Quality::suspect) << days;
    EXPECT_NE(reader.info().datum_lost, "") << days;
    bus.reset();
    bus.emplace();
  }
}

TEST_F(PoKeys57uOnHid, UnplugIsAnErrorAndReplugIsReopened) {
  run_with({.unplug_at = 5}, 100);
  EXPECT_NE(got.error.find("the device is plugged in"), std::string::npos) << got.error;
  EXPECT_NE(got.error.find("/dev/hidraw0"), std::string::npos) << got.error;
  EXPECT_GE(got.scans.size(), 5u);
  SampleBlock block;
  EXPECT_FALSE(driver.read(block, milliseconds(1)));
  expect_error(settings_of(), "is not plugged in");
  SimulatedPokeys57u again(milliseconds_now, {});
  ASSERT_NO_FATAL_FAILURE(bus->plug(3, again));
  ASSERT_TRUE(driver.open());
  got = collect(driver, 10);
  EXPECT_EQ(got.error, "");
  expect_true_values(got);
  bus.reset();
}

TEST_F(PoKeys57uOnHid, FindsTheSerialNumberInBothUsbFormats) {
  SimulatedPokeys57u other(still, {.serial = 2, .usb_serial = "2.2"});
  SimulatedPokeys57u wanted(still, {.serial = 777, .usb_serial = "777.2"});
  SimulatedPokeys57u old(still, {.serial = 5, .usb_serial = "1.5", .old_board = true});
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, other));
  ASSERT_NO_FATAL_FAILURE(bus->plug(1, wanted));
  ASSERT_NO_FATAL_FAILURE(bus->plug(2, old));
  Settings settings = settings_of();
  expect_error(settings, "3 PoKeys are plugged in");
  const std::pair<std::uint32_t, const char*> known[] = {
      {777, "/dev/hidraw1"}, {2, "/dev/hidraw0"}, {5, "/dev/hidraw2"}};
  for (const auto& [serial, path] : known) {
    settings.serial = serial;
    PoKeys57u one(settings);
    const Status opened = one.open();
    ASSERT_TRUE(opened) << opened.error().message;
    EXPECT_NE(one.info().description.find(path), std::string::npos) << one.info().description;
  }
  settings.serial = 778;
  expect_error(settings, "is not plugged in (found: 2.2, 777.2, 1.5)");
  bus.reset();
}

TEST_F(PoKeys57uOnHid, OpensWithoutInterfaceNumberThroughUhid) {
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, device, -1));
  const auto entries = list_hid(kVendor);
  ASSERT_EQ(entries.size(), 1u);
  EXPECT_EQ(entries[0].interface, -1);
  const Status opened = driver.open();
  ASSERT_TRUE(opened) << opened.error().message;
  EXPECT_EQ(collect(driver, 5).error, "");
}

TEST_F(PoKeys57uOnHid, DoesNotUseKeyboardAndJoystick) {
  SimulatedPokeys57u keyboard(still, {}), joystick(still, {});
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, keyboard, 0));
  ASSERT_NO_FATAL_FAILURE(bus->plug(2, joystick, 2));
  EXPECT_EQ(list_hid(kVendor).size(), 2u);
  expect_error(settings_of(), "is not plugged in");
  EXPECT_EQ(keyboard.requests() + joystick.requests(), 0);
  bus.reset();
}

// hid_enumerate() of hidapi 0.13.1 crashes in this situation within some milliseconds.
TEST_F(PoKeys57uOnHid, DeviceThatVanishesDuringTheSearchIsMissing) {
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, device));
  const auto uevent = bus->uevent_of(0);
  std::atomic<bool> stop = false;
  std::thread replugging([&] {
    while (!stop) {
      std::filesystem::rename(uevent, uevent.string() + ".gone");
      std::filesystem::rename(uevent.string() + ".gone", uevent);
    }
  });
  int there = 0, gone = 0;
  const auto end = steady_clock::now() + milliseconds(500);
  while (steady_clock::now() < end) ++(list_hid(kVendor).empty() ? gone : there);
  stop = true;
  replugging.join();
  EXPECT_GT(there, 0);
  EXPECT_GT(gone, 0);
}

TEST_F(PoKeys57uOnHid, ReadsBothBlocksOfCountersAndTheAnalogueInputs) {
  SimulatedPokeys57u all(still, {});
  Settings settings = settings_of({counter(0), counter(24), counter(kUltraFast)});
  settings.inputs[1].options = kEnabled | kCounts_x4;
  for (const std::size_t i : {1, 6, 0})
    settings.inputs.push_back(input("A", Unit::volt, kCounters + i));
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, all));
  PoKeys57u reader(settings);
  const Status opened = reader.open();
  ASSERT_TRUE(opened) << opened.error().message;
  got = collect(reader, 3);
  ASSERT_EQ(got.error, "");
  EXPECT_EQ(got.scans[2][0], 500);
  EXPECT_EQ(got.scans[2][1], 512);
  EXPECT_EQ(got.scans[2][2], 512.5);
  EXPECT_NEAR(got.scans[2][3], 0.55, 0.001);
  EXPECT_EQ(got.quality[2][4], Quality::over_range);
  EXPECT_EQ(got.quality[2][5], Quality::over_range);
  bus.reset();
}

// The channels need three requests, and each reply takes 60 ms. The device samples when it receives
// a request, so the last value is from the beginning of the last request.
TEST_F(PoKeys57uOnHid, AScanHasTheTimeOfItsLastRequest) {
  std::atomic<std::int64_t> last_ns = 0;
  SimulatedPokeys57u slow(
      [&](std::size_t input, std::int64_t t_ns) {
        last_ns = t_ns;
        return still(input, t_ns);
      },
      {.faults = {.latency_ns = 60'000'000}});
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, slow));
  Settings settings = settings_of({counter(0), counter(24), input("A", Unit::volt, kCounters + 1)});
  settings.inputs[1].options = kEnabled | kCounts_x4;
  PoKeys57u reader(settings);
  const Status opened = reader.open();
  ASSERT_TRUE(opened) << opened.error().message;
  SampleBlock block;
  for (int i = 0; i < 20 && block.scans() == 0; ++i)
    ASSERT_TRUE(reader.read(block, milliseconds(500)));
  ASSERT_EQ(block.scans(), 1u);
  EXPECT_GE(block.time_ns[0], last_ns);
  EXPECT_LE(block.time_ns[0], monotonic_ns());
  bus.reset();
}

TEST_F(PoKeys57uOnHid, SetsAndChecksTheCountingMode) {
  Settings settings = settings_of({counter(4)});
  ASSERT_NO_FATAL_FAILURE(bus->plug(0, device));
  expect_error(settings, "encoder5 is switched off");
  settings.inputs[0].options = kEnabled | kCounts_x2;
  bus->change([&] { device.set_faults({.ignores_options = true}); });
  expect_error(settings, "encoder5 does not accept the value of the key \"counting\"");
  bus->change([&] { device.set_faults({}); });
  EXPECT_TRUE(PoKeys57u(settings).open());
  settings.inputs[0].options.reset();
  EXPECT_TRUE(PoKeys57u(settings).open()) << "it stays set";
}

// Every program may open the devices of umockdev. Therefore this test uses a file without
// permissions instead.
TEST(HidDevice, PermissionErrorHasItsRemedy) {
  const std::string path = "/tmp/hid_test_forbidden_" + std::to_string(::getpid());
  ::close(::open(path.c_str(), O_CREAT | O_CLOEXEC, 0));
  const uid_t user = ::geteuid();
  ASSERT_EQ(::seteuid(user == 0 ? 65534 : user), 0);
  const auto opened = HidDevice::open(path);
  ASSERT_EQ(::seteuid(user), 0);
  std::remove(path.c_str());
  ASSERT_FALSE(opened);
  EXPECT_EQ(opened.error().remedy, Remedy::install_udev_rules) << opened.error().message;
}

}  // namespace
}  // namespace mdof::drivers::pokeys57u
