#include "drivers/pokeys57u/protocol.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::pokeys57u {
namespace {

using modbus::bytes;

struct Vector {
  Frame frame;
  const char* first;  // first bytes; all others are zero
};

std::vector<Vector> vectors() {
  const auto with = [](Frame frame, std::uint8_t id) {
    frame.id = id;
    return frame;
  };
  Frame enable = with(request(kEncoderOptions, 1), 6);
  enable.data[0] = enable.data[1] = kEnabled | kCounts_x4;
  return {{with(request(kDeviceData), 1), "BB 00 00 00 00 00 01 BC"},
          {with(request(kEncoderValues, 0), 2), "BB CD 00 00 00 00 02 8A"},
          {with(request(kEncoderValues, 1), 3), "BB CD 01 00 00 00 03 8C"},
          {with(request(kAnalogue, 1), 4), "BB 3A 01 00 00 00 04 FA"},
          {with(request(kTick), 5), "BB CF 00 00 00 00 05 8F"},
          {enable, "BB C4 01 00 00 00 06 86 03 03"}};
}

std::string padded(const char* hex) {
  std::string all = bytes(hex);
  all.resize(kFrameBytes, '\0');
  return all;
}

TEST(PoKeys57uProtocol, EncodesAndDecodesRequestVectors) {
  for (const Vector& vector : vectors()) {
    EXPECT_EQ(wrap(Way::request, vector.frame), padded(vector.first)) << vector.first;
    const auto read = unwrap(Way::request, padded(vector.first));
    ASSERT_TRUE(read) << vector.first;
    EXPECT_EQ(*read, vector.frame) << vector.first;
  }
}

TEST(PoKeys57uProtocol, AcceptsNothingElseAsAReply) {
  Frame frame = request(kEncoderValues);
  frame.id = 9;
  const std::string good = wrap(Way::reply, frame);
  EXPECT_EQ(unwrap(Way::reply, good), frame);
  EXPECT_FALSE(unwrap(Way::request, good));
  EXPECT_FALSE(unwrap(Way::reply, good.substr(0, 63)));
  EXPECT_FALSE(unwrap(Way::reply, good + '\0'));
  EXPECT_FALSE(unwrap(Way::reply, ""));
  // Inverts each bit that the checksum covers, and each bit of the checksum.
  for (std::size_t i = 0; i < 8; ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ (1 << bit));
      EXPECT_FALSE(unwrap(Way::reply, bad)) << i << " " << bit;
    }
  }
}

TEST(PoKeys57uProtocol, CountsAreLittleEndianUltraFastLast) {
  Frame reply;
  Counts counts{};
  for (std::size_t i = 0; i < counts.size(); ++i) counts[i] = static_cast<int>(i) - 5;
  counts[0] = INT32_MIN;
  counts[12] = INT32_MAX;
  set_counts(reply, counts);
  EXPECT_EQ(counts_of(reply), counts);
  const std::string all = wrap(Way::reply, reply);
  EXPECT_EQ(all.substr(8, 8), bytes("00 00 00 80 FC FF FF FF"));
  EXPECT_EQ(all.substr(56, 4), bytes("FF FF FF 7F"));
}

TEST(PoKeys57uProtocol, AnalogueInputsAreBigEndianTickIsLittle) {
  Frame reply;
  set_analogue(reply, {0x0123, 0, 4095, 0, 0, 0, 0x0ABC});
  EXPECT_EQ(wrap(Way::reply, reply).substr(8, 14),
            bytes("01 23 00 00 0F FF 00 00 00 00 00 00 0A BC"));
  EXPECT_EQ(analogue_of(reply)[0], 0x0123);
  EXPECT_EQ(analogue_of(reply)[6], 0x0ABC);
  set_tick(reply, 0x01020304);
  EXPECT_EQ(wrap(Way::reply, reply).substr(2, 4), bytes("04 03 02 01"));
  EXPECT_EQ(tick_of(reply), 0x01020304u);
}

TEST(PoKeys57uProtocol, ReadsTheIdentityOfBothKindsOfBoards) {
  std::string reply = padded("AA 00 00 00 32 13 01 F0 50 4B 35 38 39 30 00 00 00 00 1C");
  auto frame = unwrap(Way::reply, reply);
  ASSERT_TRUE(frame);
  EXPECT_EQ(identity_of(*frame).serial, 12345u);
  EXPECT_EQ(identity_of(*frame).model(), "PoKeys57U");
  EXPECT_EQ(identity_of(*frame).firmware, "4.2.19");
  frame = unwrap(Way::reply, padded("AA 00 30 39 32 13 01 59"));
  ASSERT_TRUE(frame);
  EXPECT_EQ(identity_of(*frame).serial, 12345u);
  EXPECT_EQ(identity_of(*frame).model(), "PoKeys");
}

TEST(PoKeys57uProtocol, AcceptsBothFormatsOfUsbSerialNumbers) {
  EXPECT_TRUE(may_be_serial("2.12345", 12345));
  EXPECT_TRUE(may_be_serial("12345.2", 12345));
  EXPECT_TRUE(may_be_serial("12345", 12345));
  EXPECT_FALSE(may_be_serial("2.123456", 12345));
  EXPECT_FALSE(may_be_serial("", 0));
  EXPECT_FALSE(may_be_serial("..x.-1", 1));
  EXPECT_FALSE(may_be_serial("99999999999999999999", 1));
}

TEST(PoKeys57uProtocol, PendingNumberIsNotUsedAgain) {
  RequestIds ids;
  const std::uint8_t late = ids.next(0);
  for (int i = 0; i < 1000; ++i) {
    const std::uint8_t id = ids.next(i);
    EXPECT_NE(id, late);
    ids.answered(id);
  }
  std::set<std::uint8_t> seen;
  for (int i = 0; i < 256; ++i) {
    seen.insert(ids.next(RequestIds::kLatest_ns));
    ids.answered(*seen.rbegin());
  }
  EXPECT_TRUE(seen.contains(late)) << "its reply cannot come any more";
}

TEST(PoKeys57uProtocol, UsesTheOldestNumberIfAllArePending) {
  RequestIds ids;
  const std::uint8_t first = ids.next(0);
  for (int i = 1; i < 256; ++i) EXPECT_NE(ids.next(i), first);
  EXPECT_EQ(ids.next(300), first);
}

TEST(PoKeys57uProtocol, UsesAFreeNumberBeforeTheOldest) {
  RequestIds ids;
  const std::uint8_t first = ids.next(0);
  for (int i = 1; i < 256; ++i) ids.next(i);
  const auto again = static_cast<std::uint8_t>(first + 5);
  ids.answered(again);
  EXPECT_EQ(ids.next(300), again);
  EXPECT_EQ(ids.next(301), first);
}

// Offsets in a frame: encoder 13 ends at byte 59, input 7 at byte 21, the tick at byte 5. Nothing
// is written beyond them.
TEST(PoKeys57uProtocol, WritesOnlyWithinTheOffsets) {
  struct {
    Counts counts;
    std::int32_t beside = -1;
  } block{};
  block.counts.fill(-1);
  Frame reply;
  set_counts(reply, block.counts);
  EXPECT_EQ(wrap(Way::reply, reply).substr(56), bytes("FF FF FF FF 00 00 00 00"));
  struct {
    Codes raw;
    std::uint16_t beside = 0xFFFF;
  } inputs{};
  inputs.raw.fill(0x0FFF);
  reply = {};
  set_analogue(reply, inputs.raw);
  EXPECT_EQ(wrap(Way::reply, reply).substr(18, 8), bytes("0F FF 0F FF 00 00 00 00"));
  reply = {};
  set_tick(reply, 0xFFFFFFFF);
  EXPECT_EQ(wrap(Way::reply, reply).substr(0, 12), bytes("AA 00 FF FF FF FF 00 A6 00 00 00 00"));
}

// The specification requires "increment per request": the next number is the last plus one.
// Numbers of pending requests are skipped.
TEST(PoKeys57uProtocol, NumbersIncreaseAndSkipPendingOnes) {
  RequestIds ids;
  const std::uint8_t owed = ids.next(0);
  for (int i = 1; i < 256; ++i) {
    const std::uint8_t id = ids.next(i);
    EXPECT_EQ(id, static_cast<std::uint8_t>(owed + i));
    ids.answered(id);
  }
  const std::uint8_t after = ids.next(256);
  EXPECT_EQ(after, static_cast<std::uint8_t>(owed + 1));
}

}  // namespace
}  // namespace mdof::drivers::pokeys57u
