// The driver reads samples of a simulated controller over sockets.
#include <cmath>

#include "tests/drivers/capancdt/rack.h"

namespace mdof::drivers::capancdt {
namespace {

TEST(Capancdt, GivesMicrometresOfItsChannels) {
  Rack rack;
  Capancdt driver(rack.options);
  EXPECT_EQ(driver.info().channels, (std::vector<Channel>{{"A", Unit::um}, {"B", Unit::um}}));
  const std::int64_t before = steady_clock::now().time_since_epoch().count();
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 100);
  const std::int64_t after = steady_clock::now().time_since_epoch().count();
  ASSERT_GE(got.all.scans(), 100u) << got.error;
  EXPECT_EQ(got.lost, 0u);
  for (std::size_t k = 0; k < got.all.scans(); ++k) {
    ASSERT_NEAR(got.all.value[0][k], 100, 1e-4);
    ASSERT_NEAR(got.all.value[1][k], 300, 1e-4);
    ASSERT_EQ(got.all.quality[0][k], Quality::good);
    ASSERT_GT(got.all.time_ns[k], before);
    // On a busy computer all packets may be late; the calculated times are then late too.
    ASSERT_LT(got.all.time_ns[k], after + 200'000'000);
  }
  const DeviceInfo info = driver.info();
  EXPECT_EQ(info.name, "probes");
  EXPECT_EQ(info.driver, "capancdt");
  EXPECT_NEAR(info.rate_hz, 1e6 / 512, 1e-9);
  expect_has(info.description, "DT6220, serial 1001, V1.2a at 127.0.0.1:");
  EXPECT_FALSE(info.simulated);
}

TEST(Capancdt, TimesAreOneSampleTimeApart) {
  SimulatedCapancdt::Options device;
  device.sample_time_us = 960;
  device.frames_per_packet = 4;
  Rack rack(device);
  // The controller uses the next shorter sample time that it has.
  rack.options.sample_time_us = 1000;
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 100);
  ASSERT_GE(got.all.scans(), 100u) << got.error;
  if (clock_stepped(driver)) GTEST_SKIP() << "this computer is too busy";
  // The clock has not settled yet. Until then, the rate of its times may differ by 20 % from the
  // true rate.
  for (std::size_t k = 1; k < got.all.scans(); ++k)
    ASSERT_NEAR(static_cast<double>(got.all.time_ns[k] - got.all.time_ns[k - 1]), 960e3,
                0.2 * 960e3 + 2)
        << k;
  EXPECT_NEAR(driver.info().rate_hz, 1e6 / 960, 1e-9);
}

TEST(Capancdt, ReturnsNothingDuringTheWarmUpOfTheClock) {
  Rack rack;
  rack.options.warm_up = 80ms;
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const auto begin = steady_clock::now();
  const Collected got = collect(driver, 1);
  EXPECT_GE(steady_clock::now() - begin, 80ms);
  ASSERT_GE(got.all.scans(), 20u) << got.error;
  EXPECT_EQ(got.lost, 0u);
}

TEST(Capancdt, AcceptsBothOrdersOfTheSizeFields) {
  for (const SizeOrder sizes : {SizeOrder::bytes_per_frame_first, SizeOrder::frames_first}) {
    SimulatedCapancdt::Options device;
    device.faults.sizes = sizes;
    device.frames_per_packet = 3;
    Rack rack(device);
    Capancdt driver(rack.options);
    ASSERT_EQ(error_of(driver.open()), "");
    const Collected got = collect(driver, 60);
    ASSERT_GE(got.all.scans(), 60u) << got.error;
    EXPECT_NEAR(got.all.value[1][59], 300, 1e-4);
    EXPECT_EQ(driver.health().skipped, 0u);
    EXPECT_EQ(got.lost, 0u);
  }
}

TEST(Capancdt, AcceptsEveryCounterUnitAndEcho) {
  using Echo = SimulatedCapancdt::Echo;
  constexpr Echo kEchoes[] = {Echo::line, Echo::reply, Echo::mixed, Echo::none};
  for (int unit = 0; unit < kCounterUnits; ++unit) {
    SimulatedCapancdt::Options device;
    device.faults.counter = static_cast<CounterUnit>(unit);
    device.faults.echo = kEchoes[unit];
    device.faults.lose_every = 10;
    device.frames_per_packet = 2;
    device.first_counter = 0xFFFFFFF0;
    Rack rack(device);
    rack.options.sample_time_us = 256;
    rack.options.averaging = Averaging::arithmetic;
    rack.options.averaged_values = 3;
    Capancdt driver(rack.options);
    ASSERT_EQ(error_of(driver.open()), "") << unit;
    const Collected got = collect(driver, 100);
    ASSERT_GE(got.all.scans(), 100u) << got.error;
    EXPECT_EQ(driver.health().counter, static_cast<CounterUnit>(unit));
    EXPECT_NEAR(driver.info().rate_hz, 1e6 / 256 / 3, 1e-9);
    EXPECT_GE(driver.health().lost, got.lost);  // some losses are not yet in a returned block
    // A packet has two frames, and every tenth packet is lost. So 2 frames are lost for 18
    // received frames.
    EXPECT_EQ(got.lost, (got.all.scans() - 1) / 18 * 2) << unit;
  }
}

TEST(Capancdt, NewBlockBeginsAfterLostFrames) {
  SimulatedCapancdt::Options device;
  device.faults.lose_every = 8;
  Rack rack(device);
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  SampleBlock block;
  std::uint64_t lost = 0;
  std::size_t scans = 0;
  std::int64_t last_ns = 0;
  while (scans < 100) {
    const auto state = driver.read(block, 20ms);
    ASSERT_TRUE(state) << state.error().message;
    if (block.scans() == 0) continue;
    if (clock_stepped(driver)) GTEST_SKIP() << "this computer is too busy";
    const auto frame = [&](std::int64_t ns) { return static_cast<double>(ns) / 512e3; };
    if (scans > 0) {
      const double due = 1 + static_cast<double>(block.lost);
      EXPECT_NEAR(frame(block.time_ns[0] - last_ns), due, 0.25 * due);
    }
    for (std::size_t k = 1; k < block.scans(); ++k)
      EXPECT_NEAR(frame(block.time_ns[k] - block.time_ns[k - 1]), 1, 0.25);
    last_ns = block.time_ns.back();
    scans += block.scans();
    lost += block.lost;
  }
  EXPECT_EQ(lost, (scans - 1) / 7);
}

TEST(Capancdt, DropsDuplicates) {
  SimulatedCapancdt::Options device;
  device.faults.repeat_every = 3;
  Rack rack(device);
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 90);
  ASSERT_GE(got.all.scans(), 90u) << got.error;
  EXPECT_EQ(got.lost, 0u);
  EXPECT_GE(driver.health().duplicates, 29u);
  if (clock_stepped(driver)) GTEST_SKIP() << "this computer is too busy";
  for (std::size_t k = 1; k < got.all.scans(); ++k)
    EXPECT_NEAR(static_cast<double>(got.all.time_ns[k] - got.all.time_ns[k - 1]), 512e3,
                0.2 * 512e3 + 2);
}

TEST(Capancdt, ValuesOfAVanishedChannelAreMissing) {
  SimulatedCapancdt::Options device;
  device.faults.missing_channel = 1;
  device.faults.vanish_from = 20;
  device.faults.vanish_packets = 15;
  for (const CounterUnit unit : {CounterUnit::frame, CounterUnit::value}) {
    device.faults.counter = unit;
    Rack rack(device);
    Capancdt driver(rack.options);
    ASSERT_EQ(error_of(driver.open()), "");
    const Collected got = collect(driver, 60);
    ASSERT_GE(got.all.scans(), 60u) << got.error;
    EXPECT_EQ(got.lost, 0u);
    EXPECT_EQ(got.count(0, Quality::missing), 15u);
    EXPECT_EQ(got.count(1, Quality::good), got.all.scans());
    for (std::size_t k = 0; k < got.all.scans(); ++k) {
      const bool gone = k >= 20 && k < 35;
      EXPECT_EQ(got.all.quality[0][k], gone ? Quality::missing : Quality::good) << k;
      EXPECT_EQ(std::isnan(got.all.value[0][k]), gone) << k;
      EXPECT_NEAR(got.all.value[1][k], 300, 1e-4) << k;
    }
  }
}

TEST(Capancdt, ReadingsAtTheEndsOfTheRangeAreOverRange) {
  Rack rack({}, [](std::size_t input, std::int64_t) { return input == 0 ? -5.0 : 5000.0; });
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 20);
  ASSERT_GE(got.all.scans(), 20u) << got.error;
  EXPECT_EQ(got.count(0, Quality::over_range), got.all.scans());
  EXPECT_EQ(got.count(1, Quality::over_range), got.all.scans());
  EXPECT_EQ(got.all.value[0][0], 0.0);
  EXPECT_EQ(got.all.value[1][0], 2000.0);
}

TEST(Capancdt, ReadingsOfAMathsChannelAreNeverOverRange) {
  SimulatedCapancdt::Options device;
  device.inputs[2].maths = true;
  Rack rack(device, [](std::size_t, std::int64_t) { return 0.0; });
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 20);
  ASSERT_GE(got.all.scans(), 20u) << got.error;
  EXPECT_EQ(got.count(0, Quality::over_range), got.all.scans());
  EXPECT_EQ(got.count(1, Quality::good), got.all.scans());
}

TEST(Capancdt, ValuesAfterInvalidDataAreSuspect) {
  SimulatedCapancdt::Options device;
  device.faults.garbage_every = 10;
  Rack rack(device);
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 60);
  ASSERT_GE(got.all.scans(), 60u) << got.error;
  EXPECT_EQ(got.lost, 0u);
  EXPECT_GE(driver.health().skipped, 6u * 8);
  for (std::size_t k = 0; k < got.all.scans(); ++k) {
    EXPECT_EQ(got.all.quality[0][k], k % 10 == 9 ? Quality::suspect : Quality::good) << k;
    EXPECT_NEAR(got.all.value[1][k], 300, 1e-4) << k;
  }
}

TEST(Capancdt, AcceptsDataInSmallPieces) {
  SimulatedCapancdt::Options device;
  device.faults.most_bytes = 5;
  Rack rack(device);
  rack.options.sample_time_us = 16384;
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 8);
  ASSERT_GE(got.all.scans(), 8u) << got.error;
  EXPECT_EQ(driver.health().skipped, 0u);
  EXPECT_EQ(got.lost, 0u);
  EXPECT_NEAR(got.all.value[0].back(), 100, 1e-4);
}

TEST(Capancdt, SecondClientGetsTheReasonOfSilence) {
  Rack rack;
  Capancdt first(rack.options);
  ASSERT_EQ(error_of(first.open()), "");
  ASSERT_GE(collect(first, 10).all.scans(), 10u);
  rack.options.silence = 50ms;
  Capancdt second(rack.options);
  ASSERT_EQ(error_of(second.open()), "");
  const Collected got = collect(second, 1);
  EXPECT_EQ(got.all.scans(), 0u);
  expect_has(got.error, "device \"probes\" at 127.0.0.1:");
  expect_has(got.error, "another client uses the data port, or the controller waits for a trigger");
  EXPECT_TRUE(second.open());  // the driver may open the device again
}

TEST(Capancdt, ReadReturnsAtItsTimeout) {
  Rack rack;
  Capancdt first(rack.options), second(rack.options);
  ASSERT_EQ(error_of(first.open()), "");
  ASSERT_GE(collect(first, 10).all.scans(), 10u);
  ASSERT_EQ(error_of(second.open()), "");
  SampleBlock block;
  const auto begin = steady_clock::now();
  ASSERT_TRUE(second.read(block, 30ms));
  const auto took = steady_clock::now() - begin;
  EXPECT_EQ(block.scans(), 0u);
  EXPECT_GE(took, 29ms);
  EXPECT_LT(took, 1500ms);
}

TEST(Capancdt, BrokenConnectionIsAnErrorAndReopens) {
  SimulatedCapancdt::Options device;
  device.faults.reset_connection_at = 30;
  Rack rack(device);
  Capancdt driver(rack.options);
  for (int turn = 0; turn < 3; ++turn) {
    ASSERT_EQ(error_of(driver.open()), "");
    const Collected got = collect(driver, 1000);
    EXPECT_LE(got.all.scans(), 31u);
    expect_has(got.error, "device \"probes\" at 127.0.0.1:");
    expect_has(got.error, "the data connection");
    SampleBlock block;
    const auto again = driver.read(block, 1ms);
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().message, got.error);
  }
}

TEST(Capancdt, RestartedCounterIsAnError) {
  SimulatedCapancdt::Options device;
  device.first_counter = 1'000'000;
  device.faults.reset_counter_at = 40;
  Rack rack(device);
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 1000);
  EXPECT_EQ(got.all.scans(), 40u);  // all scans before the fault are returned
  expect_has(got.error, "the counter in the data jumped from 1000039 to 0");
}

TEST(Capancdt, InvalidDataAloneIsAnError) {
  SimulatedCapancdt::Options device;
  device.frames_per_packet = 1000;
  device.faults.rate = 500;
  device.faults.has_invalid_preamble = true;
  Rack rack(device);
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  const Collected got = collect(driver, 1);
  EXPECT_EQ(got.all.scans(), 0u);
  expect_has(got.error, "are not data of a capaNCDT 6200; correct the key \"data_port\"");
}

TEST(Capancdt, TwoControllersAreIndependent) {
  Rack left, right({}, [](std::size_t input, std::int64_t) { return input == 0 ? 1.0 : 2.0; });
  Capancdt a(left.options), b(right.options);
  ASSERT_EQ(error_of(a.open()), "");
  ASSERT_EQ(error_of(b.open()), "");
  EXPECT_NEAR(collect(a, 20).all.value.at(1).at(19), 300, 1e-4);
  EXPECT_NEAR(collect(b, 20).all.value.at(1).at(19), 2, 1e-4);
}

}  // namespace
}  // namespace mdof::drivers::capancdt
