#include "drivers/labjack_t7/protocol.h"

#include <gtest/gtest.h>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr const char* kSevenSamples =
    "00 00 00 00 00 18 01 4C 10 00 00 00 00 00 00 00 80 00 80 01 80 02 80 03 80 04 80 05 80 06";

StreamPacket packet(std::uint16_t transaction, std::vector<std::uint16_t> samples) {
  StreamPacket p;
  p.transaction = transaction;
  p.samples = std::move(samples);
  return p;
}

TEST(LabjackT7Protocol, HighWordComesFirst) {
  EXPECT_EQ(words_of(0x00112233), (Words{0x0011, 0x2233}));
  EXPECT_EQ(u32_of(0x0011, 0x2233), kTestValue);
  EXPECT_EQ(words_of_float(1000), (Words{0x447A, 0}));
  EXPECT_EQ(float_of(0xC020, 0), -2.5F);
  EXPECT_EQ(float_of(0x411C, 0), 9.75F);
}

TEST(LabjackT7Protocol, EncodesAndReadsAStreamPacket) {
  const std::string bytes = modbus::bytes(kSevenSamples);
  const std::vector<std::uint16_t> samples = {0x8000, 0x8001, 0x8002, 0x8003,
                                              0x8004, 0x8005, 0x8006};
  EXPECT_EQ(encode(packet(0, samples)), bytes);
  PacketReader reader;
  reader.append(bytes);
  StreamPacket read;
  ASSERT_TRUE(reader.next(read).value());
  EXPECT_EQ(read.transaction, 0);
  EXPECT_EQ(read.status, 0);
  EXPECT_EQ(read.samples, samples);
  EXPECT_FALSE(reader.next(read).value());
}

TEST(LabjackT7Protocol, FieldsHaveTheirOffsets) {
  StreamPacket p = packet(0xFFFE, {1});
  p.backlog = 0x1234;
  p.status = status::recovered;
  p.info = 300;
  EXPECT_EQ(encode(p), modbus::bytes("FF FE 00 00 00 0C 01 4C 10 00 12 34 0B 7D 01 2C 00 01"));
  PacketReader reader;
  reader.append(encode(p));
  StreamPacket read;
  ASSERT_TRUE(reader.next(read).value());
  EXPECT_EQ(read.transaction, 0xFFFE);
  EXPECT_EQ(read.backlog, 0x1234);
  EXPECT_EQ(read.status, 2941);
  EXPECT_EQ(read.info, 300);
}

TEST(LabjackT7Protocol, PacketsMayArriveInAnyPortions) {
  const std::string both = encode(packet(0, {1, 2})) + encode(packet(1, {3, 4}));
  for (std::size_t cut = 0; cut <= both.size(); ++cut) {
    PacketReader reader;
    std::vector<std::uint16_t> samples;
    StreamPacket p;
    for (const std::string& part : {both.substr(0, cut), both.substr(cut)}) {
      reader.append(part);
      while (reader.next(p).value())
        samples.insert(samples.end(), p.samples.begin(), p.samples.end());
    }
    EXPECT_EQ(samples, (std::vector<std::uint16_t>{1, 2, 3, 4})) << "cut at " << cut;
  }
}

TEST(LabjackT7Protocol, RefusesOtherDataThanAStream) {
  const std::string good = modbus::bytes(kSevenSamples);
  for (const std::size_t at : {2U, 3U, 6U, 7U, 8U}) {
    std::string bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x40);
    PacketReader reader;
    reader.append(bytes);
    StreamPacket p;
    EXPECT_FALSE(reader.next(p).has_value()) << "byte " << at;
  }
  for (const char* length : {"00 08", "00 19", "04 0C", "FF FE"}) {
    PacketReader reader;
    reader.append(good.substr(0, 4) + modbus::bytes(length) + good.substr(6));
    StreamPacket p;
    EXPECT_FALSE(reader.next(p).has_value()) << length;
  }
}

// A packet of length 10 has a status and no samples.
TEST(LabjackT7Protocol, AcceptsAPacketWithoutSamples) {
  PacketReader reader;
  reader.append(modbus::bytes("00 05 00 00 00 0A 01 4C 10 00 00 00 0B 7C 00 00"));
  StreamPacket p;
  ASSERT_TRUE(reader.next(p).value());
  EXPECT_EQ(p.transaction, 5);
  EXPECT_EQ(p.status, 2940);
  EXPECT_TRUE(p.samples.empty());
}

// T-Series Datasheet 3.2.4: a packet on Ethernet has at most 512 samples. Its length is then 1034.
TEST(LabjackT7Protocol, ReadsTheLargestPacket) {
  std::string bytes = modbus::bytes("00 00 00 00 04 0A 01 4C 10 00 00 00 00 00 00 00");
  bytes.append(1024, '\x11');
  PacketReader reader;
  reader.append(bytes);
  StreamPacket p;
  ASSERT_TRUE(reader.next(p).value());
  EXPECT_EQ(p.samples, std::vector<std::uint16_t>(512, 0x1111));
  EXPECT_EQ(encode(p), bytes);
}

TEST(LabjackT7Protocol, FindsRangesAndFlashAddresses) {
  EXPECT_EQ(range_index(0.1), std::optional<std::size_t>(2));
  EXPECT_FALSE(range_index(5));
  EXPECT_EQ(flash_address(0), 0x3C4000U);
  EXPECT_EQ(flash_address(1), 0x3C4034U);
}

TEST(LabjackT7Protocol, ErrorCodesHaveTexts) {
  EXPECT_NE(error_text(2608).find("rate_hz"), std::string::npos);
  EXPECT_EQ(error_text(1234), "LabJack error 1234");
}

TEST(LabjackT7Scans, DividesPacketsIntoNumberedScans) {
  ScanNumbering line(2);
  std::vector<Scan> scans;
  ASSERT_TRUE(line.take(packet(0, {1, 2, 3, 4}), scans));
  ASSERT_TRUE(line.take(packet(1, {5, 6}), scans));
  ASSERT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans[2].index, 2U);
  EXPECT_EQ(scans[2].words, (std::vector<std::uint16_t>{5, 6}));
  EXPECT_EQ(scans[2].lost, 0U);
}

TEST(LabjackT7Scans, TransactionNumbersWrap) {
  ScanNumbering line(1);
  std::vector<Scan> scans;
  for (int i = 0; i < 65538; ++i)
    ASSERT_TRUE(line.take(packet(static_cast<std::uint16_t>(i), {0}), scans));
  EXPECT_EQ(scans.back().index, 65537U);
}

TEST(LabjackT7Scans, MissingPacketIsAnError) {
  ScanNumbering line(1);
  std::vector<Scan> scans;
  ASSERT_TRUE(line.take(packet(0, {0}), scans));
  const Status status = line.take(packet(2, {0}), scans);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find("packets are missing"), std::string::npos);
  EXPECT_EQ(scans.size(), 1U);
}

TEST(LabjackT7Scans, TimesContinueAfterDroppedScans) {
  ScanNumbering line(2);
  std::vector<Scan> scans;
  StreamPacket p = packet(0, {1, 1, 2, 2});
  p.status = status::recovering;
  ASSERT_TRUE(line.take(p, scans));  // the scans in the buffer of the T7 are valid
  p = packet(1, {3, 3, 0xFFFF, 0xFFFF, 4, 4});
  p.status = status::recovered;
  p.info = 100;
  ASSERT_TRUE(line.take(p, scans));
  ASSERT_EQ(scans.size(), 4U);
  EXPECT_EQ(scans[2].index, 2U);
  EXPECT_EQ(scans[2].lost, 0U);
  EXPECT_EQ(scans[3].index, 103U);
  EXPECT_EQ(scans[3].lost, 100U);
  EXPECT_EQ(scans[3].words, (std::vector<std::uint16_t>{4, 4}));
}

TEST(LabjackT7Scans, GapAtPacketEndPrecedesTheNextScan) {
  ScanNumbering line(1);
  std::vector<Scan> scans;
  StreamPacket p = packet(0, {7, 0xFFFF});
  p.status = status::recovered;
  p.info = 9;
  ASSERT_TRUE(line.take(p, scans));
  ASSERT_TRUE(line.take(packet(1, {8}), scans));
  ASSERT_EQ(scans.size(), 2U);
  EXPECT_EQ(scans[1].index, 10U);
  EXPECT_EQ(scans[1].lost, 9U);
}

TEST(LabjackT7Scans, GapWithoutMarkIsAnError) {
  ScanNumbering line(2);
  std::vector<Scan> scans;
  StreamPacket p = packet(0, {0xFFFF, 1, 2, 0xFFFF});
  p.status = status::recovered;
  p.info = 5;
  EXPECT_FALSE(line.take(p, scans));
  EXPECT_TRUE(scans.empty());
}

TEST(LabjackT7Scans, AllOnesWithoutAGapAreValues) {
  ScanNumbering line(2);
  std::vector<Scan> scans;
  ASSERT_TRUE(line.take(packet(0, {0xFFFF, 0xFFFF}), scans));
  EXPECT_EQ(scans.size(), 1U);
}

TEST(LabjackT7Scans, StoppedStreamIsAnError) {
  for (const int code : {2942, 2943, 2944, 2945, 1}) {
    ScanNumbering line(1);
    std::vector<Scan> scans;
    StreamPacket p = packet(0, {0});
    p.status = static_cast<std::uint16_t>(code);
    const Status status = line.take(p, scans);
    ASSERT_FALSE(status) << code;
    EXPECT_NE(status.error().message.find(std::to_string(code)), std::string::npos);
    EXPECT_TRUE(scans.empty());
  }
}

TEST(LabjackT7Scans, IncompleteScanIsAnError) {
  ScanNumbering line(2);
  std::vector<Scan> scans;
  EXPECT_FALSE(line.take(packet(0, {1, 2, 3}), scans));
}

}  // namespace
}  // namespace mdof::drivers::labjack_t7
