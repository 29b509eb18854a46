#include "drivers/capancdt/protocol.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>

namespace mdof::drivers::capancdt {
namespace {

std::string from_hex(const std::string& hex) {
  std::istringstream in(hex);
  std::string bytes;
  for (std::string two; in >> two;)
    bytes += static_cast<char>(std::strtoul(two.c_str(), nullptr, 16));
  return bytes;
}

// A packet with 4 channels, 2 frames, article 2303025, serial number 1001 and counter 1000.
const std::string kBytesFirst = from_hex(
    "53 41 45 4D 31 24 23 00 E9 03 00 00 55 00 00 00 00 00 00 00 00 00 00 00 10 00 02 00 E8 03 00 "
    "00 00 00 00 00 FF FF 7F 00 FF FF FF 00 00 00 40 00 01 00 00 00 00 00 80 00 FE FF FF 00 01 00 "
    "40 00");
std::string frames_first() {
  std::string bytes = kBytesFirst;
  std::swap(bytes[24], bytes[26]);
  return bytes;
}
Packet vector_packet() {
  return {2303025, 1001, 0x55,
          0,       1000, {0, 0x7FFFFF, 0xFFFFFF, 0x400000, 1, 0x800000, 0xFFFFFE, 0x400001}};
}
void expect_equal(const Packet& a, const Packet& b) {
  EXPECT_EQ(a.article, b.article);
  EXPECT_EQ(a.serial, b.serial);
  EXPECT_EQ(a.channel_bits, b.channel_bits);
  EXPECT_EQ(a.status, b.status);
  EXPECT_EQ(a.counter, b.counter);
  EXPECT_EQ(a.values, b.values);
}

TEST(CapancdtProtocol, EncodesTheVectorInBothOrders) {
  EXPECT_EQ(encode(vector_packet(), SizeOrder::bytes_per_frame_first), kBytesFirst);
  EXPECT_EQ(encode(vector_packet(), SizeOrder::frames_first), frames_first());
}

TEST(CapancdtProtocol, DecodesTheVectorInBothOrders) {
  for (const std::string& bytes : {kBytesFirst, frames_first()}) {
    PacketParser parser;
    parser.add(bytes);
    Packet packet;
    ASSERT_TRUE(parser.next(packet));
    expect_equal(packet, vector_packet());
    EXPECT_EQ(packet.channels(), 4);
    EXPECT_EQ(packet.frames(), 2);
    EXPECT_FALSE(packet.after_garbage);
    EXPECT_FALSE(parser.next(packet));
    EXPECT_EQ(parser.skipped(), 0u);
  }
}

TEST(CapancdtProtocol, ScalesTheVector) {
  const double um[] = {0, 999.99994, 2000, 500.00003, 0.000119, 1000.00006, 1999.99988, 500.00015};
  const Packet packet = vector_packet();
  for (std::size_t i = 0; i < std::size(um); ++i)
    EXPECT_NEAR(to_um(packet.values[i], 2000), um[i], 5e-6) << i;
  EXPECT_EQ(to_um(kFullScale, 2000), 2000.0);
}

TEST(CapancdtProtocol, DetectsEndsOfTheRange) {
  for (const std::int32_t raw : {0, kFullScale, -1, kFullScale + 1, INT32_MIN, INT32_MAX})
    EXPECT_TRUE(at_end_of_range(raw, 0)) << raw;
  for (const std::int32_t raw : {1, kFullScale - 1}) EXPECT_FALSE(at_end_of_range(raw, 0)) << raw;
  for (const std::int32_t raw : {16, kFullScale - 16}) EXPECT_TRUE(at_end_of_range(raw, 16)) << raw;
  for (const std::int32_t raw : {17, kFullScale - 17})
    EXPECT_FALSE(at_end_of_range(raw, 16)) << raw;
}

TEST(CapancdtProtocol, DecodesPacketsSplitAtAnyByte) {
  const std::string two = kBytesFirst + frames_first();
  for (std::size_t cut = 0; cut <= two.size(); ++cut) {
    PacketParser parser;
    Packet packet;
    int packets = 0;
    for (const std::string& part : {two.substr(0, cut), two.substr(cut)}) {
      parser.add(part);
      for (; parser.next(packet); ++packets) expect_equal(packet, vector_packet());
    }
    EXPECT_EQ(packets, 2) << cut;
    EXPECT_EQ(parser.skipped(), 0u) << cut;
  }
}

TEST(CapancdtProtocol, DecodesPacketsByteByByte) {
  PacketParser parser;
  Packet packet;
  int packets = 0;
  for (int i = 0; i < 3; ++i)
    for (const char c : kBytesFirst) {
      parser.add({&c, 1});
      for (; parser.next(packet); ++packets) expect_equal(packet, vector_packet());
    }
  EXPECT_EQ(packets, 3);
}

TEST(CapancdtProtocol, FindsThePacketAfterInvalidData) {
  const std::string garbage = std::string("x\0SAEMSASAE", 11) + std::string(40, 'S');
  for (std::size_t cut = 1; cut < garbage.size(); ++cut) {
    PacketParser parser;
    Packet packet;
    parser.add(garbage.substr(0, cut));
    EXPECT_FALSE(parser.next(packet));
    parser.add(garbage.substr(cut) + kBytesFirst + kBytesFirst);
    ASSERT_TRUE(parser.next(packet)) << cut;
    EXPECT_TRUE(packet.after_garbage);
    expect_equal(packet, vector_packet());
    EXPECT_EQ(parser.skipped(), garbage.size());
    ASSERT_TRUE(parser.next(packet));
    EXPECT_FALSE(packet.after_garbage);
  }
}

TEST(CapancdtProtocol, AfterInvalidDataAcceptsTheSameDeviceOnly) {
  Packet stranger = vector_packet();
  stranger.serial = 7;
  PacketParser parser;
  Packet packet;
  parser.add(kBytesFirst + "?" + encode(stranger, SizeOrder::frames_first) + kBytesFirst);
  ASSERT_TRUE(parser.next(packet));
  ASSERT_TRUE(parser.next(packet));
  expect_equal(packet, vector_packet());
  EXPECT_TRUE(packet.after_garbage);
  EXPECT_EQ(parser.skipped(), 1 + kBytesFirst.size());
}

TEST(CapancdtProtocol, SkipsATruncatedPacket) {
  for (std::size_t cut = 1; cut + 3 < kBytesFirst.size(); ++cut) {
    // This changes the counter, which FrameCounter detects and the parser cannot.
    if (cut >= 28 && cut < 32) continue;
    PacketParser parser;
    Packet packet;
    parser.add(kBytesFirst + kBytesFirst.substr(0, cut) + kBytesFirst + kBytesFirst);
    int packets = 0;
    for (; parser.next(packet); ++packets) expect_equal(packet, vector_packet());
    EXPECT_EQ(packets, 3) << cut;
    EXPECT_EQ(parser.skipped(), cut) << cut;
  }
}

TEST(CapancdtProtocol, RefusesImpossibleSizes) {
  struct {
    int a, b;
  } const sizes[] = {{16, 0}, {0, 16}, {16, 1025}, {1025, 16}, {12, 2}, {0, 0}, {65535, 65535}};
  for (const auto& [a, b] : sizes) {
    std::string bytes = kBytesFirst;
    for (std::size_t i = 0; i < 2; ++i) {
      bytes[24 + i] = static_cast<char>(a >> 8 * i);
      bytes[26 + i] = static_cast<char>(b >> 8 * i);
    }
    PacketParser parser;
    Packet packet;
    parser.add(bytes);
    EXPECT_FALSE(parser.next(packet)) << a << " " << b;
    EXPECT_GT(parser.skipped(), 0u);
  }
}

TEST(CapancdtProtocol, RefusesAPacketWithoutChannels) {
  for (const std::uint64_t bits : {std::uint64_t{0}, std::uint64_t{0xAAAA}, ~std::uint64_t{0}}) {
    std::string bytes = kBytesFirst;
    for (std::size_t i = 0; i < 8; ++i) bytes[12 + i] = static_cast<char>(bits >> 8 * i);
    PacketParser parser;
    Packet packet;
    parser.add(bytes);
    EXPECT_FALSE(parser.next(packet)) << bits;
  }
}

TEST(CapancdtProtocol, FindsThePositionsOfChannels) {
  Packet packet;
  packet.channel_bits = channel_bit(2) | channel_bit(5) | channel_bit(32);
  packet.values = {10, 20, 30, 11, 21, 31};
  EXPECT_EQ(packet.channels(), 3);
  EXPECT_EQ(packet.frames(), 2);
  EXPECT_EQ(packet.position(2), 0);
  EXPECT_EQ(packet.position(5), 1);
  EXPECT_EQ(packet.position(32), 2);
  EXPECT_EQ(packet.position(1), std::nullopt);
  EXPECT_EQ(packet.position(31), std::nullopt);
  PacketParser parser;
  parser.add(encode(packet, SizeOrder::frames_first));
  Packet back;
  ASSERT_TRUE(parser.next(back));
  expect_equal(back, packet);
}

TEST(CapancdtProtocol, DecodesTheLargestPacket) {
  Packet packet;
  for (int i = 1; i <= kMostChannels; ++i) packet.channel_bits |= channel_bit(i);
  packet.values.assign(static_cast<std::size_t>(kMostChannels) * kMostFrames, 0x123456);
  for (const SizeOrder order : {SizeOrder::bytes_per_frame_first, SizeOrder::frames_first}) {
    PacketParser parser;
    Packet back;
    parser.add(encode(packet, order));
    ASSERT_TRUE(parser.next(back));
    expect_equal(back, packet);
  }
}

// The header as the manual's table defines it. Each field has a different value, so that a wrong
// offset is detected.
TEST(CapancdtProtocol, FieldsHaveTheirOffsets) {
  const std::string bytes = from_hex(
      "53 41 45 4D 01 02 03 04 11 12 13 14 40 00 00 00 00 00 00 00 31 32 33 34 04 00 01 00 41 42 "
      "43 44 56 34 12 00");
  PacketParser parser;
  parser.add(bytes);
  Packet packet;
  ASSERT_TRUE(parser.next(packet));
  EXPECT_EQ(packet.article, 0x04030201);
  EXPECT_EQ(packet.serial, 0x14131211);
  EXPECT_EQ(packet.position(4), 0);
  EXPECT_EQ(packet.status, 0x34333231U);
  EXPECT_EQ(packet.counter, 0x44434241U);
  EXPECT_EQ(packet.values, std::vector<std::int32_t>{0x123456});
  EXPECT_EQ(encode(packet, SizeOrder::bytes_per_frame_first), bytes);
}

TEST(CapancdtProtocol, DefaultPacketIsEmpty) {
  EXPECT_EQ(Packet{}.channels(), 0);
  EXPECT_EQ(Packet{}.frames(), 0);
  EXPECT_EQ(Packet{}.counter, 0U);
}

TEST(CapancdtProtocol, ValuesOfAFrameHaveTheirIndices) {
  Packet packet;
  packet.channel_bits = 0x15;  // bits of the channels 1 to 3
  packet.values = {11, 12, 13, 21, 22, 23};
  EXPECT_EQ(packet.value(0, 0), 11);
  EXPECT_EQ(packet.value(0, 2), 13);
  EXPECT_EQ(packet.value(1, 0), 21);
  EXPECT_EQ(packet.value(1, 2), 23);
}

}  // namespace
}  // namespace mdof::drivers::capancdt
