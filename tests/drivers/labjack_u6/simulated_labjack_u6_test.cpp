// Configures the simulated U6 and reads its stream as the driver does, but without USB.
#include "drivers/labjack_u6/simulated_labjack_u6.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::labjack_u6 {
namespace {

constexpr std::size_t kSamples = 25;

// True values of the inputs. AIN1 is -2.5 V. The counter begins at -500 and increases by one per
// microsecond.
double senses(std::size_t input, std::int64_t t_ns) {
  if (input == SimulatedLabjackU6::kCounterInput)
    return std::floor(static_cast<double>(t_ns) / 1000) - 500;
  return input == 1 ? -2.5 : 20;
}

class LabjackU6Device : public testing::Test {
 protected:
  std::string ask(const std::string& command) {
    device.out(kCommandOut, command, now);
    return device.in(kReplyIn, kCommandBytes, now).bytes;
  }
  void start() {
    StreamSetup setup;
    setup.list = {{0}, {1}, {2}, {3}, {4}, {kTimer0}, {kCapture}};
    ASSERT_TRUE(read_stream_stop(ask(stream_stop())));
    ASSERT_TRUE(read_stream_config(ask(stream_config(setup, *stream_clock(1000)))));
    ASSERT_TRUE(read_stream_start(ask(stream_start())));
  }
  // Streams for `ms` milliseconds. Returns the error that ended the stream, or "".
  std::string stream(int ms) {
    now += std::int64_t{1'000'000} * ms;
    for (;;) {
      const usb::Reply got = device.in(kStreamIn, stream_bytes(kSamples), now);
      if (got.answer != usb::Answer::done) break;
      const auto packet = decode(got.bytes, kSamples);
      if (!packet) return packet.error().message;
      const Status taken = line.take(*packet, scans);
      if (!taken) return taken.error().message;
    }
    return device.gone() ? "unplugged" : "";
  }
  std::string stream_with(const SimulatedLabjackU6::Faults& faults) {
    device.set_faults(faults);
    start();
    return stream(200);
  }

  SimulatedLabjackU6 device{senses, {}};
  ScanNumbering line{7};
  std::vector<Scan> scans;
  std::int64_t now = 0;
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(LabjackU6Device, ReportsIdentityAndConstants) {
  EXPECT_EQ(read_config_u6(ask(config_u6())).value().serial, SimulatedLabjackU6::kSerial);
  std::array<CalibrationBlock, 4> blocks{};
  for (int i = 0; i < 4; ++i)
    blocks[static_cast<std::size_t>(i)] = read_calibration_reply(ask(read_calibration(i))).value();
  for (std::size_t gain = 0; gain < 4; ++gain) {
    const AinCalibration c = calibration_of(blocks, gain).value();
    EXPECT_NEAR(c.positive_slope, SimulatedLabjackU6::calibration(gain).positive_slope, 1e-9);
    EXPECT_NEAR(c.negative_slope, SimulatedLabjackU6::calibration(gain).negative_slope, 1e-9);
    EXPECT_NEAR(c.centre, SimulatedLabjackU6::calibration(gain).centre, 1e-9);
  }
  EXPECT_TRUE(read_config_io(ask(config_io(2, 0)), 2, 0));
  EXPECT_TRUE(read_feedback(ask(start_quadrature())));
}

TEST_F(LabjackU6Device, AnswersTheVectors) {
  EXPECT_EQ(ask(stream_stop()), modbus::bytes("E5 B1 34 00"));
  start();
  EXPECT_EQ(ask(stream_stop()), modbus::bytes("B1 B1 00 00"));
  EXPECT_EQ(ask(stream_start()), modbus::bytes("A9 A9 00 00"));
  EXPECT_EQ(ask("\xA8\xA9"), modbus::bytes("B8 B8"));
}

TEST_F(LabjackU6Device, StreamsInputsAndCounterInOneScan) {
  start();
  ASSERT_EQ(stream(200), "");
  ASSERT_GT(scans.size(), 180U);
  for (const Scan& scan : scans) {
    ASSERT_NEAR(labjack::volts(SimulatedLabjackU6::calibration(0), scan.words[1]), -2.5, 2e-4);
    ASSERT_TRUE(labjack::at_rail(scan.words[0]));
    const auto raw = static_cast<std::uint32_t>(scan.words[6]) << 16 | scan.words[5];
    ASSERT_EQ(static_cast<std::int32_t>(raw), static_cast<std::int64_t>(scan.index) * 1000 - 450);
  }
}

// AIN0 (20 V) minus AIN1 (-2.5 V) is outside of the range. AIN2 minus AIN3 is 0 V.
TEST_F(LabjackU6Device, DifferentialEntryHasItsOwnGain) {
  StreamSetup setup;
  setup.list = {{1, 0}, {2, 1, true}, {0, 0, true}};
  ASSERT_TRUE(read_stream_config(ask(stream_config(setup, *stream_clock(1000)))));
  ASSERT_TRUE(read_stream_start(ask(stream_start())));
  line = ScanNumbering(3);
  ASSERT_EQ(stream(200), "");
  ASSERT_GT(scans.size(), 150U);
  EXPECT_NEAR(labjack::volts(SimulatedLabjackU6::calibration(0), scans[9].words[0]), -2.5, 2e-4);
  EXPECT_NEAR(labjack::volts(SimulatedLabjackU6::calibration(1), scans[9].words[1]), 0, 2e-5);
  EXPECT_TRUE(labjack::at_rail(scans[9].words[2]));
}

TEST_F(LabjackU6Device, TimesContinueAfterDroppedScans) {
  SimulatedLabjackU6::Faults faults;
  faults.recovery_at = 4;
  faults.dropped = 60;
  ASSERT_EQ(stream_with(faults), "");
  std::uint64_t lost = 0;
  for (const Scan& scan : scans) {
    lost += scan.lost;
    const auto raw = static_cast<std::uint32_t>(scan.words[6]) << 16 | scan.words[5];
    ASSERT_EQ(static_cast<std::int32_t>(raw), static_cast<std::int64_t>(scan.index) * 1000 - 450);
  }
  EXPECT_EQ(lost, 60U);
  EXPECT_GT(scans.back().index, 150U);
}

TEST_F(LabjackU6Device, StreamFaultsEndTheStream) {
  SimulatedLabjackU6::Faults stop, skip, cut, unplug;
  stop.stop_at = skip.skip_at = cut.short_at = unplug.unplug_at = 3;
  EXPECT_TRUE(has(stream_with(stop), "U6 error 55"));
  line = ScanNumbering(7);
  stop.stop_error = kRecoveryOverflow;
  EXPECT_TRUE(has(stream_with(stop), "U6 error 63"));
  line = ScanNumbering(7);
  EXPECT_TRUE(has(stream_with(skip), "packets are missing"));
  line = ScanNumbering(7);
  EXPECT_NE(stream_with(cut), "");
  line = ScanNumbering(7);
  EXPECT_EQ(stream_with(unplug), "unplugged");
  EXPECT_TRUE(device.gone());
}

TEST_F(LabjackU6Device, StopsAStreamThatRunsAtTheStart) {
  SimulatedLabjackU6::Faults faults;
  faults.streaming = true;
  device = SimulatedLabjackU6(senses, {.faults = faults});
  EXPECT_TRUE(has(read_stream_start(ask(stream_start())).error().message, "48"));
  start();
  EXPECT_EQ(stream(50), "");
}

TEST_F(LabjackU6Device, BothSidesDetectBadChecksums) {
  std::string command = config_u6();
  command[7] = 1;
  EXPECT_EQ(ask(command), modbus::bytes("B8 B8"));
  SimulatedLabjackU6::Faults faults;
  faults.deaf = true;
  device.set_faults(faults);
  EXPECT_TRUE(has(read_config_u6(ask(config_u6())).error().message, "B8 B8"));
  faults = {};
  faults.wrong_checksum = true;
  device.set_faults(faults);
  EXPECT_TRUE(has(read_config_u6(ask(config_u6())).error().message, "checksum"));
  EXPECT_TRUE(has(read_stream_stop(ask(stream_stop())).error().message, "checksum"));
}

TEST_F(LabjackU6Device, FullTransferOrShortPacketEndsATransfer) {
  SimulatedLabjackU6::Faults cut;
  cut.short_at = 5;
  device.set_faults(cut);
  start();
  now += 15'000'000;  // time of four packets
  EXPECT_EQ(device.in(kStreamIn, 256, now).bytes.size(), 256U);
  EXPECT_EQ(device.in(kStreamIn, 256, now).answer, usb::Answer::not_yet);
  now += 15'000'000;
  EXPECT_EQ(device.in(kStreamIn, 256, now).bytes.size(), 64U + 20U);
  EXPECT_EQ(device.in(0x84, 64, now).answer, usb::Answer::stall);
  EXPECT_EQ(device.out(0x04, "x", now).answer, usb::Answer::stall);
  EXPECT_EQ(device.control({0xC0, 1, 0, 0, 4}, "", now).answer, usb::Answer::stall);
}

}  // namespace
}  // namespace mdof::drivers::labjack_u6
