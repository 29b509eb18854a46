// Commands that LabJack's open source sends to a U6, and replies that it accepts. The checksums
// were calculated with its setChecksum16 and setChecksum8 (LabJackPython, src/LabJackPython.py).
#include <gtest/gtest.h>

#include "drivers/labjack_u6/simulated_labjack_u6.h"
#include "tests/drivers/vendor_vector.h"

namespace mdof::drivers::labjack_u6 {
namespace {

using modbus::bytes;

class LabjackU6Vectors : public testing::Test {
 protected:
  std::string ask(const std::string& command) {
    device.out(kCommandOut, command, 0);
    return device.in(kReplyIn, kCommandBytes, 0).bytes;
  }
  SimulatedLabjackU6 device{[](std::size_t, std::int64_t) { return 0; }, {}};
};

TEST_F(LabjackU6Vectors, SimulatedDeviceAnswersAsTheVendorAccepts) {
  const VendorVector kVectors[] = {
      {"ConfigU6, read",
       "0B F8 0A 08 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00",
       ".. F8 10 08 .. .. 00 .. .. .. .. .. .. .. .. .. .. .. .. 06 00 .. .. .. .. .. .. .. .. .. "
       ".. "
       ".. .. .. .. .. .. 04",
       "labjack/LabJackPython, src/u6.py, U6.configU6"},
      {"ConfigIO, read", "09 F8 05 0B 00 00 00 00 00 00 00 00 00 00 00 00",
       "09 F8 05 0B 00 00 00 00 00 00 00 00 00 00 00 00",
       "labjack/LabJackPython, src/u6.py, U6.configIO"},
      {"ConfigIO, two timers", "0C F8 05 0B 03 00 01 02 00 00 00 00 00 00 00 00",
       "0B F8 05 0B 02 00 00 00 02 00 00 00 00 00 00 00",
       "labjack/LabJackPython, src/u6.py, U6.configIO"},
      {"ConfigIO, two timers from FIO2 on", "0E F8 05 0B 05 00 01 02 00 02 00 00 00 00 00 00",
       "0D F8 05 0B 04 00 00 00 02 00 02 00 00 00 00 00",
       "labjack/LabJackPython, src/u6.py, U6.configIO, TimerCounterPinOffset"},
      {"ConfigIO, none", "0A F8 05 0B 01 00 01 00 00 00 00 00 00 00 00 00",
       "09 F8 05 0B 00 00 00 00 00 00 00 00 00 00 00 00",
       "labjack/exodriver, examples/U6/u6Stream.c, ConfigIO_example"},
      {"Feedback, two timers in mode 8", "66 F8 05 00 68 00 00 2B 08 00 00 2D 08 00 00 00",
       "FA F8 02 00 00 00 00 00 00 00",
       "labjack/LabJackPython, src/u6.py, U6.getFeedback, TimerConfig"},
      {"ReadCal, block 0", "27 F8 01 2D 00 00 00 00",
       ".. F8 11 2D .. .. 00 .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. .. "
       ".. "
       ".. .. .. .. .. .. .. .. ..",
       "labjack/LabJackPython, src/u6.py, U6.readMem"},
      {"StreamStop, none running", "B0 B0", "E5 B1 34 00",
       "labjack/exodriver, examples/U6/u6Stream.c, StreamStop; 52: LabJackPython, "
       "src/LabJackPython.py, errorcodes"},
      {"StreamConfig, five inputs at 1 kHz",
       "EB F8 09 11 D8 00 05 01 19 00 00 00 A0 0F 00 00 01 00 02 00 03 00 04 00",
       "0B F8 01 11 00 00 00 00",
       "labjack/exodriver, examples/U6/u6Stream.c, StreamConfig_example"},
      {"StreamStart", "A8 A8", "A9 A9 00 00",
       "labjack/exodriver, examples/U6/u6Stream.c, StreamStart"},
      {"StreamStop", "B0 B0", "B1 B1 00 00",
       "labjack/exodriver, examples/U6/u6Stream.c, StreamStop"},
      {"a wrong checksum", "0C F8 05 0B 03 00 01 02 00 00 00 00 00 00 00 01", "B8 B8",
       "labjack/LabJackPython, src/LabJackPython.py, Device._checkCommandBytes"},
  };
  for (const VendorVector& vector : kVectors)
    EXPECT_EQ(mismatch(ask(bytes(vector.request)), vector.reply), "") << vector;
}

// LabJack documents this reply to ConfigU6: firmware 0.88, serial number 360005087, version info
// 4.
TEST_F(LabjackU6Vectors, ReadsTheIdentityOfLabJacksExample) {
  const auto id = read_config_u6(
      bytes("33 F8 10 08 20 02 00 00 00 58 00 0F 06 00 02 DF 3D 75 15 06 00 01 00 00 00 00 00 00 "
            "00 00 00 00 00 00 00 00 00 04"));  // LabJackPython, src/u6.py, U6.configU6
  ASSERT_TRUE(id) << id.error().message;
  EXPECT_EQ(id->serial, 360005087U);
  EXPECT_EQ(id->firmware_major, 0);
  EXPECT_EQ(id->firmware_minor, 88);
  EXPECT_FALSE(id->pro);
}

// LabJackPython, src/u6.py, U6.configIO: result[8] is the number of timers, result[10] is the pin
// offset. exodriver's u6Stream.c uses the same bytes.
TEST_F(LabjackU6Vectors, ReadsTimersFromBytes8And10) {
  const auto timers = read_timers(bytes("0C F8 05 0B 03 00 00 00 02 00 01 00 00 00 00 00"));
  ASSERT_TRUE(timers) << timers.error().message;
  EXPECT_EQ(timers->count, 2);
  EXPECT_EQ(timers->pin_offset, 1);
}

// Packet according to exodriver, examples/U6/u6Stream.c, StreamData_example:
// - bytes 1 to 3: F9, 4 + number of samples, C0
// - bytes 6 and 7: dropped scans
// - byte 10: counter
// - byte 11: error
// - byte 12 and following: samples, then the backlog
TEST_F(LabjackU6Vectors, StreamPacketsHaveTheVendorsOffsets) {
  ASSERT_EQ(mismatch(ask(bytes("EB F8 09 11 D8 00 05 01 19 00 00 00 A0 0F 00 00 01 00 02 00 03 00 "
                               "04 00")),
                     "0B F8 01 11 00 00 00 00"),
            "");
  ask(stream_start());
  const std::string packet = device.in(kStreamIn, 64, 10'000'000).bytes;
  std::string pattern = ".. F9 1D C0 .. .. .. .. .. .. 00 00";
  for (int i = 0; i < 50; ++i) pattern += " ..";
  EXPECT_EQ(mismatch(packet, pattern + " .. .."), "");
  const auto read = decode(bytes("76 F9 05 C0 B5 01 2C 01 00 00 07 3C 34 12 FF 00"), 1);
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->counter, 7);
  EXPECT_EQ(read->error, kRecovered);
  EXPECT_EQ(read->dropped, 300);
  EXPECT_EQ(read->samples, std::vector<std::uint16_t>{0x1234});
  EXPECT_EQ(read->backlog, 255);
}

// Source: LabJackPython, src/u6.py, CalibrationInfo and binaryToCalibratedAnalogVoltage, gain 0.
TEST_F(LabjackU6Vectors, NominalConstantsHaveTheVendorsSigns) {
  const AinCalibration nominal = labjack::nominal_calibration(0);
  EXPECT_NEAR(nominal.positive_slope, 3.1580578e-4, 1e-12);
  EXPECT_NEAR(nominal.negative_slope, -3.158058e-4, 1e-10);
  EXPECT_EQ(nominal.centre, 33523.0);
  EXPECT_NEAR(labjack::volts(nominal, 0), 33523.0 * -3.158058e-4, 1e-6);
  EXPECT_NEAR(labjack::volts(nominal, 65535), (65535 - 33523.0) * 3.1580578e-4, 1e-6);
}

// Sources: exodriver, liblabjackusb/labjackusb.h: LJ_VENDOR_ID, U6_PRODUCT_ID, U6_PIPE_EP1_OUT,
// U6_PIPE_EP2_IN, U6_PIPE_EP3_IN. U6 Datasheet 5.1: at most 64 bytes in each direction.
TEST_F(LabjackU6Vectors, EndpointsAreThoseOfTheExodriver) {
  EXPECT_EQ(kVendor, 0x0CD5);
  EXPECT_EQ(kProduct, 6);
  EXPECT_EQ(kCommandOut, 0x01);
  EXPECT_EQ(kReplyIn, 0x82);
  EXPECT_EQ(kStreamIn, 0x83);
  EXPECT_EQ(kCommandBytes, 64U);
  EXPECT_EQ(kAins, 14);
}

// The error codes of a stream. Source: LabJackPython, src/LabJackPython.py, errorcodes.
TEST_F(LabjackU6Vectors, StreamErrorsHaveTexts) {
  for (const int code : {48, 49, 50, 52, 55, 56, 58, 59, 60, 63})
    EXPECT_TRUE(error_text(code).starts_with("U6 error " + std::to_string(code) + ", ")) << code;
  for (const int code : {47, 51, 53, 54, 57, 61, 62})
    EXPECT_EQ(error_text(code), "U6 error " + std::to_string(code));
}

// U6 Datasheet 5.2.12: bits 5-4 of a channel's options are the gain, and byte 10 is the settling
// time in units of 10 us. Code: LabJackPython, src/u6.py, U6.streamConfig.
TEST_F(LabjackU6Vectors, EncodesGainAndSettlingOfAStream) {
  StreamSetup setup;
  setup.settling_10us = 5;
  setup.resolution_index = 3;
  setup.samples_per_packet = 20;
  setup.list = {{1, 2}, {kTimer0}, {kCapture}};
  EXPECT_EQ(stream_config(setup, {2, 0x1234, 0}),
            bytes("43 F8 07 11 30 02 03 03 14 00 05 02 34 12 01 20 C8 00 E0 00"));
}

// LabJackPython, src/u6.py, U6.streamConfig: in the options of a channel, bit 7 means differential
// and bits 5-4 are the gain. exodriver, examples/U6/u6.c, eAIN: the negative input of an even
// input is the next odd input.
TEST_F(LabjackU6Vectors, StreamInputsHaveTheirOwnGains) {
  StreamSetup setup;
  setup.list = {{0, 0, true}, {2, 1, true}, {4, 2, false}, {6, 3, true}, {8, 0, false}};
  EXPECT_EQ(stream_config(setup, *stream_clock(1000)),
            bytes("D7 F8 09 11 C2 02 05 01 19 00 00 00 A0 0F 00 80 02 90 04 20 06 B0 08 00"));
}

}  // namespace
}  // namespace mdof::drivers::labjack_u6
