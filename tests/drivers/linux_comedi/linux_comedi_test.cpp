#include "drivers/linux_comedi/linux_comedi.h"

#include <gtest/gtest.h>

#include "tests/drivers/collect.h"
#include "tests/drivers/linux_comedi/simulated_board.h"
#include "tests/shown.h"

namespace mdof::drivers::linux_comedi {
namespace {

class ComediBoard : public testing::Test {
 protected:
  ComediBoard() {
    settings_.name = "daq";
    settings_.rate_hz = 2000;
    settings_.inputs = {{{"A", Unit::volt}, 0}, {{"B", Unit::volt}, 5}};
    settings_.open = SimulatedBoard::opener(board_);
  }
  std::string refusal() const {
    LinuxComedi driver(settings_);
    const auto status = driver.open();
    EXPECT_EQ(board_->opened, board_->closed);
    return status ? "opened" : status.error().message;
  }
  void expect_refused(const std::string& part) const {
    const std::string message = refusal();
    EXPECT_NE(message.find(part), std::string::npos) << message;
    EXPECT_EQ(message.rfind("device \"daq\" (/dev/comedi0): ", 0), 0U) << message;
  }
  DeviceInfo opened() {
    LinuxComedi driver(settings_);
    const auto status = driver.open();
    EXPECT_TRUE(status) << status.error().message;
    return driver.info();
  }
  std::shared_ptr<Simulated> board_ = std::make_shared<Simulated>();
  Settings settings_;
};

TEST_F(ComediBoard, ReadsVoltsOfWholeScans) {
  board_->most_bytes = 7;  // 7 bytes are neither whole samples nor whole scans
  LinuxComedi driver(settings_);
  const std::int64_t before_ns = monotonic_ns();
  ASSERT_TRUE(driver.open());
  EXPECT_EQ(driver.info().channels, (std::vector<Channel>{{"A", Unit::volt}, {"B", Unit::volt}}));
  EXPECT_EQ(driver.info().rate_hz, 2000);
  const Collected all = collect(driver, 1000);
  const std::int64_t after_ns = monotonic_ns();
  ASSERT_GE(all.scans.size(), 1000U) << all.error;
  for (std::size_t i = 0; i < 1000; ++i) {
    ASSERT_NEAR(all.scans[i][0], -10 + 20.0 * static_cast<double>(i % 500 + 1000) / 65535, 1e-9)
        << i;
    ASSERT_NEAR(all.scans[i][1], -10 + 20.0 * static_cast<double>(i % 500 + 6000) / 65535, 1e-9)
        << i;
    ASSERT_EQ(all.quality[i][1], Quality::good);
  }
  EXPECT_EQ(all.lost, 0U);
  expect_growing(all.time_ns);
  EXPECT_GT(all.time_ns.front(), before_ns);
  EXPECT_LT(all.time_ns.back(), after_ns);
  std::int64_t least_ns = INT64_MAX, most_ns = 0;
  for (std::size_t i = 1; i < 1000; ++i) {
    least_ns = std::min(least_ns, all.time_ns[i] - all.time_ns[i - 1]);
    most_ns = std::max(most_ns, all.time_ns[i] - all.time_ns[i - 1]);
  }
  EXPECT_GT(least_ns, 300'000);  // the times follow the clock of the board
  EXPECT_LT(most_ns, 700'000);
  EXPECT_EQ(board_->started.subdevice, 1U);  // subdevice 0 has no analogue inputs
  EXPECT_EQ(board_->started.inputs[1].channel, 5U);
}

TEST_F(ComediBoard, NewestScanOfALongReadHasThePresentTime) {
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  const std::int64_t before_ns = monotonic_ns();
  const Collected all = collect(driver, 400);
  const std::int64_t after_ns = monotonic_ns();
  ASSERT_GE(all.scans.size(), 400U) << all.error;
  EXPECT_GT(all.time_ns.back(), before_ns - 60'000'000);
  EXPECT_LT(all.time_ns.back(), after_ns);
}

TEST_F(ComediBoard, ReadsLongSamplesInTheirOwnRange) {
  board_->subdevices[1].long_samples = true;
  board_->greatest_code = 16'777'215;
  board_->code = [](std::uint64_t, unsigned channel) {
    return channel == 0 ? 70'000U : 8'388'608U;
  };
  settings_.inputs[1].low_v = 0;
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 3);
  EXPECT_NEAR(all.scans.at(2)[0], -10 + 20 * 70'000.0 / 16'777'215, 1e-9);
  EXPECT_NEAR(all.scans.at(2)[1], 5, 1e-6);
  EXPECT_EQ(board_->started.inputs[1].range, 2U);
}

TEST_F(ComediBoard, ReadingsAtTheEndsOfARangeAreOverRange) {
  board_->code = [](std::uint64_t scan, unsigned channel) {
    return channel == 5 ? 30'000U : scan % 2 == 0 ? 0U : 65535U;
  };
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(all.quality.at(i)[0], Quality::over_range);
    EXPECT_NEAR(all.scans[i][0], i % 2 == 0 ? -10 : 10, 1e-9);
    EXPECT_EQ(all.quality[i][1], Quality::good);
  }
}

TEST_F(ComediBoard, BufferOverrunIsACountedGap) {
  board_->overrun_at = 300;
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  const Collected before = collect(driver, 10'000);
  EXPECT_EQ(before.scans.size(), 300U);  // all scans before the fault are returned
  EXPECT_EQ(before.lost, 0U);
  EXPECT_NE(
      before.error.find("the buffer of the board, or of the kernel (8.192 s), has overflowed"),
      std::string::npos)
      << before.error;
  SampleBlock block;
  // Reads fail until the driver is opened again.
  EXPECT_FALSE(driver.read(block, std::chrono::milliseconds(1)));
  board_->overrun_at = -1;
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  ASSERT_TRUE(driver.open());
  const Collected after = collect(driver, 100);
  ASSERT_GE(after.scans.size(), 100U) << after.error;
  const double away = static_cast<double>(after.time_ns[0] - before.time_ns.back()) * 1e-9 * 2000;
  EXPECT_GT(away, 190);
  EXPECT_NEAR(static_cast<double>(after.lost), away - 1, 1);
  // The driver has started a new command.
  EXPECT_NEAR(after.scans[0][0], -10 + 20 * 1000.0 / 65535, 1e-9);
  EXPECT_EQ(board_->closed, 1);
}

TEST_F(ComediBoard, BoardThatVanishesOrStopsIsAnError) {
  board_->unplug_at = 20;
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  EXPECT_NE(collect(driver, 10'000).error.find("the board is gone"), std::string::npos);
  board_->open_error = "No such device";
  ASSERT_FALSE(driver.open());
  board_->open_error.clear();
  board_->unplug_at = -1;
  board_->end_at = 50;
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 10'000);
  EXPECT_EQ(all.scans.size(), 50U);
  EXPECT_NE(all.error.find("has stopped scanning without a request"), std::string::npos);
}

TEST_F(ComediBoard, SilenceIsAnError) {
  board_->silent_at = 10;
  settings_.rate_hz = 10'000;
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 10'000);
  EXPECT_EQ(all.scans.size(), 10U);
  EXPECT_NE(all.error.find("no data for 2.051 s"), std::string::npos) << all.error;
}

TEST_F(ComediBoard, ErrorNamesTheOptionsOfTheBoard) {
  settings_.inputs[0].reference = Reference::common;
  expect_refused(
      "CH0: reference = \"common\" is not possible; the board offers ground, differential");
  settings_.inputs[0].reference = Reference::differential;
  settings_.inputs[0].high_v = 7;
  expect_refused(
      "CH0: the board has no range -10 to 7 V; range_v can be -10 to 10 V, -5 to 5 V, 0 to 10 V, 0 "
      "to 20");
  settings_.inputs[1].number = 8;
  settings_.inputs[0].high_v = 10;
  expect_refused("the board has no input CH8; the last input is CH7");
  settings_.subdevice = 0;
  expect_refused("subdevice 0 has no analogue inputs that stream; possible subdevices: 1");
  board_->subdevices[1].streams = false;
  expect_refused("the board has no analogue inputs that stream");
  settings_.board = "pci-6229";
  expect_refused(
      "the board is \"sim-6221\" (driver sim_driver), but the configuration has board = "
      "\"pci-6229\"");
  board_->open_error = "Permission denied";
  expect_refused("/dev/comedi0: Permission denied");
}

TEST_F(ComediBoard, ReportsTheTrueRateAndRefusesAWrongOne) {
  board_->tick_ns = 1500;
  settings_.rate_hz = 10'000;  // 100 us are 66.7 ticks. The board uses 67 ticks, which are 100.5 us
  const DeviceInfo info = opened();
  EXPECT_NEAR(info.rate_hz, 1e9 / 100'500, 1e-9);
  board_->tick_ns = 50'350;  // the rate differs by 0.7 %
  EXPECT_NEAR(opened().rate_hz, 1e9 / 100'700, 1e-9);
  board_->tick_ns = 50'600;  // the rate differs by 1.2 %
  expect_refused("the nearest rate is 9881.42292");
  board_->tick_ns = 70'000;
  expect_refused(
      "the board cannot scan at rate_hz = 10000; the nearest rate is 7142.85714 Hz with 2 inputs, "
      "converted at intervals of 70 us");
  board_->tick_ns = 1000;
  // The conversions of two inputs take longer than the period of a scan.
  board_->least_convert_ns = 60'000;
  expect_refused("the nearest rate is 8333.33333");
}

TEST_F(ComediBoard, ReportsARefusedCommand) {
  board_->refuses_inputs = true;
  expect_refused(
      "the board refuses the command (invalid chanlist); the board cannot scan these inputs "
      "together with these ranges and references");
  board_->refuses_inputs = false;
  board_->start_error = "the board refuses the command: Device or resource busy";
  expect_refused("Device or resource busy");
}

TEST_F(ComediBoard, DescribesTheBoard) {
  EXPECT_EQ(opened().description,
            "Comedi sim_driver sim-6221 at /dev/comedi0, subdevice 1, inputs 20 us apart, a buffer "
            "of 8.192 s, nominal ranges without calibration");
  EXPECT_TRUE(opened().notices.empty());
}

TEST_F(ComediBoard, WarnsOfTheKernelsTestBoard) {
  board_->driver = "comedi_test";
  ASSERT_EQ(opened().notices.size(), 1U);
  EXPECT_EQ(opened().notices[0].code, NoticeCode::board_simulated);
}

TEST_F(ComediBoard, UsesACalibrationFile) {
  board_->subdevices[1].soft_calibrated = true;
  board_->calibration.found = true;
  board_->calibration.to_volts = {Polynomial{{0.25, 1e-3, 0, 0}, 500}, std::nullopt};
  board_->code = [](std::uint64_t, unsigned) { return 1500U; };
  LinuxComedi driver(settings_);
  ASSERT_TRUE(driver.open());
  const Collected all = collect(driver, 1);
  EXPECT_NEAR(all.scans.at(0)[0], 1.25, 1e-12);
  EXPECT_NEAR(all.scans.at(0)[1], -10 + 20 * 1500.0 / 65535, 1e-9);
  const DeviceInfo info = driver.info();
  EXPECT_NE(info.description.find(", calibrated by /var/lib/comedi/calibrations/sim"),
            std::string::npos);
  ASSERT_EQ(info.notices.size(), 1U);
  EXPECT_NE(test::shown(info.notices[0]).find("contains no calibration of CH5 at -10 to 10 V"),
            std::string::npos);
}

TEST_F(ComediBoard, WarnsIfTheCalibrationFileIsMissing) {
  board_->subdevices[1].soft_calibrated = true;
  ASSERT_EQ(opened().notices.size(), 1U);
  EXPECT_NE(test::shown(opened().notices[0])
                .find("sim does not exist; create this file with comedi_soft_calibrate"),
            std::string::npos);
  board_->subdevices[1].soft_calibrated = false;
  board_->calibration.found = true;
  board_->calibration.wrong = "cannot be read, or is not a calibration file";
  board_->code = [](std::uint64_t, unsigned) { return 1500U; };
  ASSERT_EQ(opened().notices.size(), 1U);
  EXPECT_NE(test::shown(opened().notices[0]).find("sim: cannot be read"), std::string::npos);
  EXPECT_NE(opened().description.find("nominal"), std::string::npos);
}

}  // namespace
}  // namespace mdof::drivers::linux_comedi
