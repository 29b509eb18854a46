// The driver configures a simulated controller over sockets.
#include "tests/drivers/capancdt/rack.h"
#include "tests/shown.h"

namespace mdof::drivers::capancdt {
namespace {

TEST(CapancdtSetup, ChecksTheIdentity) {
  Rack rack;
  rack.options.serial = "1001";
  EXPECT_EQ(error_of(Capancdt(rack.options).open()), "");
  rack.options.serial = "1002";
  expect_has(error_of(Capancdt(rack.options).open()),
             "but the configuration has serial = 1002; correct the key \"serial\"");
}

TEST(CapancdtSetup, RefusesAMissingChannel) {
  SimulatedCapancdt::Options device;
  device.inputs[2].present = false;
  Rack rack(device);
  const std::string absent = error_of(Capancdt(rack.options).open());
  expect_has(absent,
             "rig.toml:7: channel.id: the device has no input \"3\"; the inputs of the device are "
             "1, 2, 4");
  rack.options.channels[1].number = 5;
  rack.options.channels[1].input.input = "5";
  expect_has(error_of(Capancdt(rack.options).open()), "no input \"5\"");
}

TEST(CapancdtSetup, UsesTheReportedRangeOrElseTheConfiguredRange) {
  SimulatedCapancdt::Options device;
  device.inputs[0].range_um = 500;
  Rack reported(device);
  Capancdt driver(reported.options);
  ASSERT_EQ(error_of(driver.open()), "");
  EXPECT_NEAR(collect(driver, 5).all.value.at(0).at(0), 100, 1e-4);
  reported.options.channels[0].range_um = 2000;
  expect_has(error_of(Capancdt(reported.options).open()), "the controller reports 500");

  device.states_range = false;
  Rack untold(device);
  expect_has(error_of(Capancdt(untold.options).open()), "set the key \"range_um\"");
  for (auto& channel : untold.options.channels) channel.range_um = channel.number == 1 ? 500 : 2000;
  Capancdt given(untold.options);
  ASSERT_EQ(error_of(given.open()), "");
  EXPECT_NEAR(collect(given, 5).all.value.at(0).at(0), 100, 1e-4);
}

TEST(CapancdtSetup, ReportsCorrectionsByTheController) {
  SimulatedCapancdt::Options device;
  Rack plain(device);
  Capancdt without(plain.options);
  ASSERT_EQ(error_of(without.open()), "");
  EXPECT_TRUE(without.info().notices.empty());

  device.linearisation = {5, 3, 2, 0};  // the rig uses the inputs 1 and 3
  device.low_pass = 1;
  Rack rack(device);
  rack.options.channels[0].rig_corrects = true;
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  EXPECT_EQ(test::shown(driver.info().notices),
            "linearised_twice A mode=5 input=1\nlinearised_by_controller B mode=2\n"
            "low_pass_on mode=1\n");

  device.supports_corrections = false;
  Rack older(device);
  Capancdt untold(older.options);
  ASSERT_EQ(error_of(untold.open()), "");
  EXPECT_EQ(test::shown(untold.info().notices), "linearisation_unknown\n");
}

// The mean of 8 values with a sample time of 131 ms takes 1.05 s. This is longer than the settling
// time of a stop.
TEST(CapancdtSetup, RefusesAveragingLongerThanSettling) {
  SimulatedCapancdt::Options device;
  device.sample_time_us = 131072;
  device.averaged_values = 8;
  for (const int kind : {1, 2, 3, 4}) {
    device.averaging = kind;
    Rack rack(device);
    rack.options.sample_time_us.reset();
    rack.options.settle_s = 1;
    expect_has(error_of(Capancdt(rack.options).open()),
               "the averaging takes 1.049 s, which is longer than settle_s = 1 s");
    rack.options.settle_s = 1.05;
    EXPECT_EQ(error_of(Capancdt(rack.options).open()), "");
  }
  device.averaging = 0;
  Rack rack(device);
  rack.options.sample_time_us.reset();
  rack.options.settle_s = 0.01;
  EXPECT_EQ(error_of(Capancdt(rack.options).open()), "");
}

TEST(CapancdtSetup, ReportsSettingsItMustNotChange) {
  SimulatedCapancdt::Options device;
  device.sample_time_us = 1024;
  device.trigger = 1;
  Rack triggered(device);
  triggered.options.configure = false;
  expect_has(error_of(Capancdt(triggered.options).open()), "waits for a trigger (TRG 1)");

  device.trigger = 0;
  Rack rack(device);
  rack.options.configure = false;
  expect_has(error_of(Capancdt(rack.options).open()), "sample_time_us is 1024 on the controller");
  rack.options.sample_time_us = 1024;
  rack.options.averaging = Averaging::median;
  expect_has(error_of(Capancdt(rack.options).open()),
             "averaging is \"none\" on the controller, but \"median\" in the configuration");
  rack.options.averaging.reset();
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  EXPECT_GE(collect(driver, 5).all.scans(), 5u);
}

TEST(CapancdtSetup, SetsTheTriggerToContinuous) {
  SimulatedCapancdt::Options device;
  device.trigger = 2;
  Rack rack(device);
  Capancdt driver(rack.options);
  ASSERT_EQ(error_of(driver.open()), "");
  EXPECT_GE(collect(driver, 5).all.scans(), 5u);
}

TEST(CapancdtSetup, SilentControllerIsAnError) {
  SimulatedCapancdt::Options device;
  device.faults.mute = true;
  Rack rack(device);
  rack.options.reply_timeout = 30ms;
  expect_has(error_of(Capancdt(rack.options).open()),
             "no answer to $VER; check that this is the command");
  Capancdt driver(rack.options);
  SampleBlock block;
  const auto state = driver.read(block, 1ms);
  ASSERT_FALSE(state);
  expect_has(state.error().message, "is not open");
}

TEST(CapancdtSetup, UnreachableControllerIsAnError) {
  Options options;
  {
    const ServedDevice gone(2);
    options = options_for(gone);
  }
  const std::string error = error_of(Capancdt(options).open());
  expect_has(error, "device \"probes\": 127.0.0.1:" + std::to_string(options.command.port));
  expect_has(error, "the device is switched on and connected to the network");
}

}  // namespace
}  // namespace mdof::drivers::capancdt
