#include "drivers/labjack_u6/protocol.h"

#include <gtest/gtest.h>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::labjack_u6 {
namespace {

using modbus::bytes;

std::string zeros(std::size_t n) {
  return std::string(n, '\0');
}

TEST(LabjackU6Protocol, EncodesTheCommandVectors) {
  EXPECT_EQ(config_u6(), bytes("0B F8 0A 08 00 00") + zeros(20));
  EXPECT_EQ(read_calibration(0), bytes("27 F8 01 2D 00 00 00 00"));
  EXPECT_EQ(read_calibration(9), bytes("30 F8 01 2D 09 00 00 09"));
  EXPECT_EQ(config_io(2, 0), bytes("0C F8 05 0B 03 00 01 02 00 00 00 00 00 00 00 00"));
  EXPECT_EQ(start_quadrature(), bytes("66 F8 05 00 68 00 00 2B 08 00 00 2D 08 00 00 00"));
  EXPECT_EQ(stream_start(), bytes("A8 A8"));
  EXPECT_EQ(stream_stop(), bytes("B0 B0"));
}

// The frame of a Feedback command that reads AIN0-4 and timer 0. The driver does not send this
// command; it only checks the framing.
TEST(LabjackU6Protocol, FramesAFeedbackOfFiveInputs) {
  const std::string vector = bytes(
      "49 F8 0D 00 43 00 00 02 00 01 00 02 01 01 00 02 02 01 00 02 03 01 00 02 04 01 00 2A 00 00 "
      "00 "
      "00");
  EXPECT_EQ(extended(kFeedback, vector.substr(6)), vector);
  EXPECT_EQ(extended_body(vector, kFeedback, vector.size()).value(), vector.substr(6));
}

TEST(LabjackU6Protocol, EncodesTheStreamConfigVectors) {
  StreamSetup setup;
  setup.list = {{0}, {1}, {2}, {3}, {4}};
  const auto clock = stream_clock(1000);
  ASSERT_TRUE(clock);
  EXPECT_EQ(clock->rate_hz, 1000);
  EXPECT_EQ(stream_config(setup, *clock),
            bytes("EB F8 09 11 D8 00 05 01 19 00 00 00 A0 0F 00 00 01 00 02 00 03 00 04 00"));
  setup.list = {{0}, {1}, {2}, {3}, {4}, {kTimer0}, {kCapture}};
  EXPECT_EQ(stream_config(setup, *clock),
            bytes("99 F8 0B 11 82 02 07 01 19 00 00 00 A0 0F 00 00 01 00 02 00 03 00 04 00 C8 00 "
                  "E0 00"));
}

TEST(LabjackU6Protocol, StreamClockCoversSlowAndFastRates) {
  EXPECT_EQ(stream_clock(10)->config, 2);
  EXPECT_NEAR(stream_clock(10)->rate_hz, 10, 0.01);
  EXPECT_NEAR(stream_clock(7000)->rate_hz, 7000, 10);
  EXPECT_FALSE(stream_clock(0.01));
  EXPECT_FALSE(stream_clock(0));
  EXPECT_FALSE(stream_clock(1e9));
}

// U6 Datasheet 5.2.12: the scan interval is 1 to 65535 periods of 4 MHz, or of 4 MHz / 256.
TEST(LabjackU6Protocol, StreamClockUsesTheLimitsOfTheInterval) {
  const auto longest = stream_clock(4e6 / 65535);  // 61.04 Hz
  ASSERT_TRUE(longest);
  EXPECT_EQ(longest->config, 0);
  EXPECT_EQ(longest->interval, 65535);
  const auto divided = stream_clock(4e6 / 65536);
  ASSERT_TRUE(divided);
  EXPECT_EQ(divided->config, 2);
  EXPECT_EQ(divided->interval, 256);
  EXPECT_EQ(stream_clock(15625.0 / 65535)->interval, 65535);
  EXPECT_FALSE(stream_clock(15625.0 / 65536));
  EXPECT_EQ(stream_clock(4e6)->interval, 1);
}

TEST(LabjackU6Protocol, RefusesTooLongReplies) {
  EXPECT_FALSE(read_stream_start(bytes("A9 A9 00 00 00")));
  EXPECT_FALSE(read_stream_config(bytes("0B F8 01 11 00 00 00 00 00 00")));
}

TEST(LabjackU6Protocol, ReadsReplies) {
  EXPECT_TRUE(read_stream_config(bytes("0B F8 01 11 00 00 00 00")));
  EXPECT_TRUE(read_stream_start(bytes("A9 A9 00 00")));
  EXPECT_TRUE(read_stream_stop(bytes("B1 B1 00 00")));
  EXPECT_TRUE(read_stream_stop(bytes("E5 B1 34 00")));  // error 52: no stream was running
}

TEST(LabjackU6Protocol, RefusalsHaveTexts) {
  const Status active = read_stream_config(extended(kStreamConfig, bytes("30 00")));
  ASSERT_FALSE(active);
  EXPECT_NE(active.error().message.find("48, a stream is already active"), std::string::npos);
  EXPECT_EQ(error_text(99), "U6 error 99");
}

TEST(LabjackU6Protocol, RefusesBadReplies) {
  const auto says = [](const Status& status) { return status ? "" : status.error().message; };
  EXPECT_NE(says(read_stream_config(bytes("B8 B8"))).find("B8 B8"), std::string::npos);
  EXPECT_NE(says(read_stream_start(bytes("B8 B8"))).find("B8 B8"), std::string::npos);
  EXPECT_NE(says(read_stream_config(bytes("0C F8 01 11 00 00 00 00"))).find("checksum"),
            std::string::npos);
  EXPECT_NE(says(read_stream_config(bytes("0B F8 01 11 00 00 00 01"))).find("checksum"),
            std::string::npos);
  EXPECT_NE(says(read_stream_start(bytes("B1 B1 00 00"))).find("another command"),
            std::string::npos);
  EXPECT_NE(says(read_stream_start(bytes("AA A9 00 00"))).find("checksum"), std::string::npos);
  for (const std::size_t size : {0U, 1U, 5U, 7U})
    EXPECT_FALSE(read_stream_config(bytes("0B F8 01 11 00 00 00 00").substr(0, size))) << size;
  EXPECT_FALSE(read_feedback(bytes("0B F8 01 11 00 00 00 00")));
}

// The vendor's calculateChecksum8 (exodriver, examples/U6/u6.c) adds the carry twice. Example: FF
// + FF + 01 = 1FF; 1 + FF = 100; 1 + 00 = 01.
TEST(LabjackU6Protocol, ChecksumAddsItsCarryTwice) {
  EXPECT_EQ(checksum8(bytes("FF FF 01")), 1);
  EXPECT_EQ(checksum8(bytes("FF FF")), 0xFF);
}

TEST(LabjackU6Protocol, ReadsTheIdentity) {
  std::string body = zeros(32);
  body[3] = 15;
  body[4] = 1;
  body.replace(9, 4, bytes("15 CD 5B 15"));  // 0x155BCD15
  body[31] = 12;
  const auto identity = read_config_u6(extended(kConfigU6, body));
  ASSERT_TRUE(identity) << identity.error().message;
  EXPECT_EQ(identity->serial, 0x155BCD15U);
  EXPECT_EQ(identity->firmware_major, 1);
  EXPECT_EQ(identity->firmware_minor, 15);
  EXPECT_TRUE(identity->pro);
}

TEST(LabjackU6Protocol, ReadsCalibrationAsFixedPoint) {
  const auto block = read_calibration_reply(
      extended(kReadCalibration, zeros(2) + bytes("00 00 00 80 01 00 00 00"  // 1.5
                                                  "00 00 00 40 FF FF FF FF"  // -0.75
                                                  "00 00 00 00 F3 82 00 00"  // 33523
                                                  "00 00 00 00 00 00 00 00")));
  ASSERT_TRUE(block) << block.error().message;
  EXPECT_EQ(*block, (CalibrationBlock{1.5, -0.75, 33523, 0}));
}

TEST(LabjackU6Protocol, EachGainHasItsConstants) {
  std::array<CalibrationBlock, 4> blocks{};
  for (std::size_t gain = 0; gain < 4; ++gain) {
    const AinCalibration c = labjack::nominal_calibration(gain);
    blocks[gain / 2][2 * (gain % 2)] = c.positive_slope;
    blocks[2 + gain / 2][2 * (gain % 2)] = c.negative_slope;
    blocks[2 + gain / 2][2 * (gain % 2) + 1] = c.centre + static_cast<double>(gain);
  }
  for (std::size_t gain = 0; gain < 4; ++gain)
    EXPECT_EQ(calibration_of(blocks, gain).value().centre, 33523 + static_cast<double>(gain));
  blocks[0][0] = 0;
  EXPECT_FALSE(calibration_of(blocks, 0));
}

StreamData ramp() {
  StreamData packet;
  for (int i = 0; i < 25; ++i) packet.samples.push_back(static_cast<std::uint16_t>(0x8000 + i));
  return packet;
}

TEST(LabjackU6Protocol, EncodesTheStreamPacketVector) {
  std::string vector = bytes("91 F9 1D C0 AC 0D 00 00 00 00 00 00");
  for (int i = 0; i < 25; ++i) vector += {static_cast<char>(i), static_cast<char>(0x80)};
  vector += zeros(2);
  ASSERT_EQ(vector.size(), 64U);
  EXPECT_EQ(encode(ramp()), vector);
  const auto packet = decode(vector, 25);
  ASSERT_TRUE(packet) << packet.error().message;
  EXPECT_EQ(packet->samples, ramp().samples);
  EXPECT_EQ(packet->counter, 0);
  EXPECT_EQ(packet->error, 0);
}

TEST(LabjackU6Protocol, PacketFieldsHaveTheirOffsets) {
  StreamData packet = ramp();
  packet.counter = 200;
  packet.error = kRecovered;
  packet.dropped = 0x1234;
  packet.backlog = 77;
  const auto read = decode(encode(packet), 25);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->counter, 200);
  EXPECT_EQ(read->error, kRecovered);
  EXPECT_EQ(read->dropped, 0x1234);
  EXPECT_EQ(read->backlog, 77);
}

TEST(LabjackU6Protocol, RefusesChangedBytesAndShortReads) {
  const std::string good = encode(ramp());
  for (std::size_t i = 0; i < good.size(); ++i) {
    std::string changed = good;
    changed[i] = static_cast<char>(changed[i] ^ 1);
    EXPECT_FALSE(decode(changed, 25)) << i;
    EXPECT_FALSE(decode(good.substr(0, i), 25)) << i;
  }
}

// The checksums are correct. Only the command or the type differs.
TEST(LabjackU6Protocol, RefusesRepliesToOtherCommands) {
  const std::string body = zeros(4), reply = extended(0x0A, body);
  EXPECT_TRUE(extended_body(reply, 0x0A, reply.size()));
  EXPECT_FALSE(extended_body(reply, 0x0B, reply.size()));
  std::string packet = encode(ramp());
  ASSERT_TRUE(decode(packet, 25));
  packet[1] = static_cast<char>(packet[1] - 1);
  packet[0] = static_cast<char>(checksum8(packet.substr(1, 5)));
  EXPECT_FALSE(decode(packet, 25));
}

TEST(LabjackU6PacketLine, ScansContinueOverPacketsAndCounterWraps) {
  ScanNumbering line(7);
  std::vector<Scan> scans;
  StreamData packet = ramp();
  for (int i = 0; i < 600; ++i, ++packet.counter) ASSERT_TRUE(line.take(packet, scans));
  EXPECT_EQ(scans.size(), 600U * 25 / 7);
}

TEST(LabjackU6PacketLine, MissingPacketIsAnError) {
  ScanNumbering line(7);
  std::vector<Scan> scans;
  StreamData packet = ramp();
  ASSERT_TRUE(line.take(packet, scans));
  packet.counter = 2;
  EXPECT_FALSE(line.take(packet, scans));
}

TEST(LabjackU6PacketLine, TimesContinueAfterDroppedScans) {
  ScanNumbering line(5);
  std::vector<Scan> scans;
  StreamData packet = ramp();
  packet.error = kRecovering;
  ASSERT_TRUE(line.take(packet, scans));
  packet.counter = 1;
  packet.error = kRecovered;
  packet.dropped = 1000;
  std::fill_n(packet.samples.begin(), 5, 0xFFFF);
  ASSERT_TRUE(line.take(packet, scans));
  ASSERT_EQ(scans.size(), 9U);
  EXPECT_EQ(scans[4].index, 4U);
  EXPECT_EQ(scans[5].index, 1005U);
  EXPECT_EQ(scans[5].lost, 1000U);
}

TEST(LabjackU6PacketLine, StoppedStreamIsAnError) {
  for (const int code : {55, 63, 1}) {
    ScanNumbering line(5);
    std::vector<Scan> scans;
    StreamData packet = ramp();
    packet.error = static_cast<std::uint8_t>(code);
    const Status status = line.take(packet, scans);
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().message.find("U6 error " + std::to_string(code)), std::string::npos);
  }
}

}  // namespace
}  // namespace mdof::drivers::labjack_u6
