// Requests of PoLabs' own library, and replies as this library parses them: c-core-labs/pokeyslib.
#include <gtest/gtest.h>

#include <algorithm>

#include "drivers/pokeys57u/simulated_pokeys57u.h"
#include "tests/drivers/vendor_vector.h"

namespace mdof::drivers::pokeys57u {
namespace {

using modbus::bytes;

// Encoder n has the count n, the ultra-fast encoder has -2. The first analogue input is at the end
// of its range.
double senses(std::size_t input, std::int64_t /*t_ns*/) {
  if (input < kEncoders) return static_cast<double>(input + 1);
  return input == kUltraFast ? -2 : input == kCounters ? kAnalogueTop_V : 0;
}

// Adds bytes `with` until the frame is complete. In `hex`, spaces separate the bytes.
std::string padded(const std::string& hex, const char* with) {
  std::string all = hex;
  const auto given = 1 + std::count(hex.begin(), hex.end(), ' ');
  for (auto i = static_cast<std::size_t>(given); i < kFrameBytes; ++i) all += with;
  return all;
}

TEST(PoKeys57uVectors, SimulatedDeviceAnswersAsTheVendorAccepts) {
  // A reply begins with 0xAA. Byte 6 is the number of the request. Byte 7 is the sum of the bytes
  // 0 to 6. Source: PoKeysLibCore.c, SendRequest.
  const VendorVector vectors[] = {
      {"encoders 1 to 13", "BB CD 00 00 00 00 02 8A",
       "AA .. .. .. .. .. 02 .. 01 00 00 00 02 00 00 00 03 00 00 00 04 00 00 00 05 00 00 00 06 00 "
       "00 "
       "00 07 00 00 00 08 00 00 00 09 00 00 00 0A 00 00 00 0B 00 00 00 0C 00 00 00 0D 00 00 00",
       "c-core-labs/pokeyslib, PoKeysLibEncoders.c, PK_EncoderValuesGet"},
      {"encoders 14 to 25, and the ultra-fast one last", "BB CD 01 00 00 00 03 8C",
       "AA .. .. .. .. .. 03 .. 0E 00 00 00 0F 00 00 00 10 00 00 00 11 00 00 00 12 00 00 00 13 00 "
       "00 "
       "00 14 00 00 00 15 00 00 00 16 00 00 00 17 00 00 00 18 00 00 00 19 00 00 00 FE FF FF FF",
       "c-core-labs/pokeyslib, PoKeysLibEncoders.c, PK_EncoderValuesGet"},
      {"analogue inputs, more significant byte first", "BB 3A 01 00 00 00 04 FA",
       "AA .. .. .. .. .. 04 .. 0F FF 00 00 00 00 00 00 00 00 00 00 00 00",
       "c-core-labs/pokeyslib, PoKeysLibIO.c, PK_AnalogIOGet"},
      {"device data: PK58, serial number 12345", "BB 00 00 00 00 00 01 BC",
       "AA .. .. .. .. .. 01 .. 50 4B 35 38 39 30 00 00 .. .. 1C",
       "c-core-labs/pokeyslib, PoKeysLibDeviceData.c, PK_DeviceDataGet"},
      {"options of the encoders", "BB C4 00 00 00 00 05 84", "AA .. .. .. .. .. 05 .. 00 00",
       "c-core-labs/pokeyslib, PoKeysLibEncoders.c, PK_EncoderConfigurationGet"},
  };
  for (const VendorVector& vector : vectors) {
    SimulatedPokeys57u device(senses, {});
    device.out(SimulatedPokeys57u::kOut, bytes(padded(vector.request, " 00")), 0);
    const std::string reply = device.in(SimulatedPokeys57u::kIn, kFrameBytes, 2'000'000).bytes;
    EXPECT_EQ(mismatch(reply, padded(vector.reply, "..")), "") << vector;
    ASSERT_EQ(reply.size(), kFrameBytes);
    unsigned sum = 0;
    for (std::size_t i = 0; i < 7; ++i) sum += static_cast<unsigned char>(reply[i]);
    EXPECT_EQ(static_cast<unsigned char>(reply[7]), sum & 0xFF) << vector;
  }
}

// PoKeysLibCore.c: vendor 0x1DC3, product 0x1001, interface 1, frames of 64 bytes. Specification:
// 25 encoders, an ultra-fast encoder, and seven analogue inputs of 12 bits and 0 to 3.3 V.
TEST(PoKeys57uVectors, NumbersEqualTheVendors) {
  EXPECT_EQ(kVendor, 0x1DC3);
  EXPECT_EQ(kProduct, 0x1001);
  EXPECT_EQ(kInterface, 1);
  EXPECT_EQ(kFrameBytes, 64U);
  EXPECT_EQ(kEncoders, 25U);
  EXPECT_EQ(kUltraFast, 25U);
  EXPECT_EQ(kCounters, 26U);
  EXPECT_EQ(kAnalogues, 7U);
  EXPECT_EQ(kAnalogueTop, 4095);
  EXPECT_EQ(kAnalogueTop_V, 3.3);
}

// Source: the table of hardware numbers in the specification.
TEST(PoKeys57uVectors, BoardsHaveNames) {
  const auto named = [](int hardware) { return Identity{1, hardware, ""}.model(); };
  EXPECT_EQ(named(10), "PoKeys56U");
  EXPECT_EQ(named(28), "PoKeys57U");
  EXPECT_EQ(named(30), "PoKeys57U v1.1");
  EXPECT_EQ(named(32), "PoKeys57CNC");
  EXPECT_EQ(named(99), "PoKeys");
}

}  // namespace
}  // namespace mdof::drivers::pokeys57u
