#include "drivers/modbus/protocol.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::modbus {
namespace {

struct Vector {
  const char* what;
  Framing framing;
  std::uint16_t transaction;
  std::string pdu;
  const char* adu;
};

// Requests and replies from the manuals of a LabJack T7, an ADAM-6017 and a Lika SMAX.
std::vector<Vector> vectors() {
  const std::array<std::uint16_t, 2> ten_volts = {0x4120, 0};
  const std::array<std::uint16_t, 2> quadrature = {0, 10};
  const std::array<std::uint16_t, 2> rate_1000 = {0x447A, 0};
  const std::array<std::uint16_t, 2> one = {0, 1};
  const auto tcp = Framing::tcp, rtu = Framing::rtu;
  return {
      {"T7 AIN0-4", tcp, 1, read_request(kReadHolding, 0, 10),
       "00 01 00 00 00 06 01 03 00 00 00 0A"},
      {"T7 AIN0-4 reply", tcp, 1, bytes("03 14 3F800000 C0200000 3E000000 411C0000 C1200000"),
       "00 01 00 00 00 17 01 03 14 3F800000 C0200000 3E000000 411C0000 C1200000"},
      {"T7 TEST", tcp, 2, read_request(kReadHolding, 55100, 2),
       "00 02 00 00 00 06 01 03 D7 3C 00 02"},
      {"T7 TEST reply", tcp, 2, bytes("03 04 00 11 22 33"),
       "00 02 00 00 00 07 01 03 04 00 11 22 33"},
      {"T7 DIO0_EF_READ_A", tcp, 3, read_request(kReadHolding, 3000, 2),
       "00 03 00 00 00 06 01 03 0B B8 00 02"},
      {"T7 AIN_ALL_RANGE", tcp, 4, write_request(43900, ten_volts),
       "00 04 00 00 00 0B 01 10 AB 7C 00 02 04 41 20 00 00"},
      {"T7 DIO0_EF_INDEX", tcp, 5, write_request(44100, quadrature),
       "00 05 00 00 00 0B 01 10 AC 44 00 02 04 00 00 00 0A"},
      {"T7 scan rate", tcp, 6, write_request(4002, rate_1000),
       "00 06 00 00 00 0B 01 10 0F A2 00 02 04 44 7A 00 00"},
      {"T7 STREAM_ENABLE", tcp, 7, write_request(4990, one),
       "00 07 00 00 00 0B 01 10 13 7E 00 02 04 00 00 00 01"},
      {"ADAM inputs", tcp, 1, read_request(kReadHolding, 0, 8),
       "00 01 00 00 00 06 01 03 00 00 00 08"},
      {"ADAM ranges", tcp, 2, read_request(kReadHolding, 200, 8),
       "00 02 00 00 00 06 01 03 00 C8 00 08"},
      {"ADAM name", tcp, 3, read_request(kReadHolding, 210, 2),
       "00 03 00 00 00 06 01 03 00 D2 00 02"},
      {"SMAX 0-1", rtu, 0, read_request(kReadInput, 0, 2), "01 04 00 00 00 02 71 CB"},
      {"SMAX 0-1 reply", rtu, 0, bytes("04 04 00 00 04 D2"), "01 04 04 00 00 04 D2 79 19"},
      {"SMAX 0-6", rtu, 0, read_request(kReadInput, 0, 7), "01 04 00 00 00 07 B1 C8"},
      {"SMAX 0-6 reply", rtu, 0, bytes("04 0E 00 00 04 D2 00 00 00 00 01 00 01 01 00 01"),
       "01 04 0E 00 00 04 D2 00 00 00 00 01 00 01 01 00 01 6F BE"},
      {"SMAX exception 02", rtu, 0, bytes("84 02"), "01 84 02 C2 C1"},
  };
}

TEST(ModbusProtocol, EncodesAndDecodesEveryVector) {
  for (const Vector& v : vectors()) {
    EXPECT_EQ(wrap(v.framing, {v.transaction, 1, v.pdu}), bytes(v.adu)) << v.what;
    const auto frame = unwrap(v.framing, bytes(v.adu));
    ASSERT_TRUE(frame) << v.what << ": " << frame.error().message;
    EXPECT_EQ(frame->transaction, v.transaction) << v.what;
    EXPECT_EQ(frame->unit, 1) << v.what;
    EXPECT_EQ(frame->pdu, v.pdu) << v.what;
  }
}

TEST(ModbusProtocol, ReplyHasTheRequestedRegisters) {
  const Frame asked{0, 1, read_request(kReadInput, 0, 2)};
  const auto answer = answer_to(asked, Framing::rtu, bytes("01 04 04 00 00 04 D2 79 19"));
  ASSERT_TRUE(answer) << answer.error().message;
  EXPECT_EQ(answer->exception, 0);
  EXPECT_EQ(word_at(answer->registers, 2), 1234);
  const auto refused = answer_to(asked, Framing::rtu, bytes("01 84 02 C2 C1"));
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->exception, 2);
}

std::string why_not(Framing framing, const Frame& asked, const std::string& adu) {
  const auto answer = answer_to(asked, framing, adu);
  return answer ? "accepted" : answer.error().message;
}

TEST(ModbusProtocol, RefusesOtherRepliesWithTheReason) {
  const Frame asked{9, 7, read_request(kReadHolding, 100, 2)};
  const Frame good{9, 7, bytes("03 04 00 11 22 33")};
  const auto tcp = [&](const Frame& reply) {
    return why_not(Framing::tcp, asked, wrap(Framing::tcp, reply));
  };
  const auto rtu = [&](const Frame& reply) {
    return why_not(Framing::rtu, asked, wrap(Framing::rtu, reply));
  };
  EXPECT_EQ(tcp(good), "accepted");
  EXPECT_EQ(rtu(good), "accepted");
  EXPECT_EQ(tcp({8, 7, good.pdu}), "the reply has transaction 8 instead of 9");
  EXPECT_EQ(tcp({9, 6, good.pdu}), "the reply has unit 6 instead of 7");
  EXPECT_EQ(rtu({9, 6, good.pdu}), "the reply has unit 6 instead of 7");
  EXPECT_EQ(rtu({9, 7, bytes("04 04 00 11 22 33")}), "the reply has function 4 instead of 3");
  EXPECT_EQ(rtu({9, 7, bytes("84 02")}), "the reply has function 132 instead of 3");
  EXPECT_EQ(rtu({9, 7, bytes("83 00")}), "the reply has function 131 instead of 3");
  EXPECT_EQ(rtu({9, 7, bytes("03 02 00 11")}), "the reply has byte count 2 instead of 4");
  EXPECT_EQ(rtu({9, 7, bytes("03 04 00 11")}), "the reply has byte count 2 instead of 4");
  EXPECT_EQ(rtu({9, 7, bytes("03 02 00 11 22 33")}), "the reply has byte count 4 instead of 4");
}

TEST(ModbusProtocol, RefusesAWrongHeader) {
  const Frame asked{2, 1, read_request(kReadHolding, 55100, 2)};
  const std::string good = bytes("00 02 00 00 00 07 01 03 04 00 11 22 33");
  EXPECT_EQ(why_not(Framing::tcp, asked, good), "accepted");
  for (const std::size_t at : {0u, 1u, 2u, 3u, 4u, 5u, 6u, 7u, 8u}) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x40);
    EXPECT_NE(why_not(Framing::tcp, asked, bad), "accepted") << at;
  }
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_NE(why_not(Framing::tcp, asked, good.substr(0, size)), "accepted") << size;
  EXPECT_NE(why_not(Framing::tcp, asked, good + '\0'), "accepted");
}

// MODBUS Messaging on TCP/IP 3.1.3: the length includes the unit and the PDU. A PDU has at least a
// function.
TEST(ModbusProtocol, ReplyWithoutAFunctionIsIncomplete) {
  const Frame asked{2, 1, read_request(kReadHolding, 55100, 2)};
  EXPECT_EQ(why_not(Framing::tcp, asked, bytes("00 02 00 00 00 01 01")), "the reply is incomplete");
  EXPECT_EQ(why_not(Framing::tcp, asked, bytes("00 02 00 00 00 00")), "the reply is incomplete");
  EXPECT_EQ(why_not(Framing::tcp, asked, bytes("00 02 00 00 00 08 01 03 04 00 11 22 33")),
            "the reply has length 8 instead of 7");
}

TEST(ModbusProtocol, CrcProtectsEveryBitOfAnRtuReply) {
  const Frame asked{0, 1, read_request(kReadInput, 0, 2)};
  const std::string good = bytes("01 04 04 00 00 04 D2 79 19");
  for (std::size_t bit = 0; bit < 8 * good.size(); ++bit) {
    std::string bad = good;
    bad[bit / 8] = static_cast<char>(bad[bit / 8] ^ (1 << bit % 8));
    EXPECT_EQ(why_not(Framing::rtu, asked, bad), "the CRC of the reply is wrong") << bit;
  }
  for (std::size_t size = 0; size < good.size(); ++size)
    EXPECT_NE(why_not(Framing::rtu, asked, good.substr(0, size)), "accepted") << size;
}

TEST(ModbusProtocol, EchoConfirmsAWrite) {
  const std::array<std::uint16_t, 2> values = {1, 2};
  const Frame asked{4, 1, write_request(43900, values)};
  const auto reply = [&](const char* pdu) {
    return why_not(Framing::tcp, asked, wrap(Framing::tcp, {4, 1, bytes(pdu)}));
  };
  EXPECT_EQ(reply("10 AB 7C 00 02"), "accepted");
  EXPECT_EQ(reply("10 AB 7D 00 02"), "the reply confirms a write that was not requested");
  EXPECT_EQ(reply("10 AB 7C 00 01"), "the reply confirms a write that was not requested");
  EXPECT_EQ(reply("10 AB 7C 00 02 00"), "the reply confirms a write that was not requested");
}

TEST(ModbusProtocol, ExceptionsHaveNames) {
  // Source: MODBUS Application Protocol V1.1b3, section 7. Exception 7 is from the older Modicon
  // guide.
  EXPECT_STREQ(exception_name(1), "illegal function");
  EXPECT_STREQ(exception_name(3), "illegal data value");
  EXPECT_STREQ(exception_name(4), "server device failure");
  EXPECT_STREQ(exception_name(5), "acknowledge");
  EXPECT_STREQ(exception_name(6), "server device busy");
  EXPECT_STREQ(exception_name(7), "negative acknowledge");
  EXPECT_STREQ(exception_name(8), "memory parity error");
  EXPECT_STREQ(exception_name(10), "gateway path unavailable");
  EXPECT_STREQ(exception_name(0), "unknown");
  EXPECT_STREQ(exception_name(12), "unknown");
  EXPECT_STREQ(exception_name(2), "illegal data address");
  EXPECT_STREQ(exception_name(11), "gateway target device failed to respond");
  EXPECT_STREQ(exception_name(9), "unknown");
  EXPECT_STREQ(exception_name(255), "unknown");
  EXPECT_STREQ(exception_name(-1), "unknown");
}

}  // namespace
}  // namespace mdof::drivers::modbus
