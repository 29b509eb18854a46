#include "tools/mdof_simulate/usbip.h"

#include <gtest/gtest.h>

#include <vector>

#include "drivers/pokeys57u/simulated_pokeys57u.h"
#include "tests/drivers/modbus/hex.h"

namespace mdof::simulate {
namespace {

using drivers::modbus::bytes;
namespace family = drivers::pokeys57u;

std::string word(std::uint32_t value) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(value >> shift);
  return text;
}
std::uint32_t word_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i)
    value = value << 8 | static_cast<std::uint8_t>(bytes.at(i));
  return value;
}

// A submit command as the kernel's vhci_hcd sends it.
std::string submit(std::uint32_t number, int endpoint, std::uint32_t length,
                   const std::string& setup = "", const std::string& out = "", bool in = true) {
  std::string text = word(1) + word(number) + word(0x10002) + word(in ? 1 : 0) +
                     word(static_cast<std::uint32_t>(endpoint)) + word(0) + word(length) + word(0) +
                     word(0xFFFFFFFF) + word(1) + (setup.empty() ? std::string(8, '\0') : setup);
  return text + out;
}
std::string unlink(std::uint32_t number, std::uint32_t other) {
  std::string text = word(2) + word(number) + word(0x10002) + word(0) + word(0) + word(other);
  text.resize(48, '\0');
  return text;
}

struct Got {
  std::uint32_t command, number;
  std::int32_t status;
  std::uint32_t actual;
  std::string bytes;
};
// `in`: the transfers are IN transfers, so the answers contain bytes.
std::vector<Got> parse(std::string text, bool in = true) {
  std::vector<Got> all;
  while (text.size() >= 48) {
    Got got{word_at(text, 0), word_at(text, 4), static_cast<std::int32_t>(word_at(text, 20)),
            word_at(text, 24), ""};
    text.erase(0, 48);
    if (in && got.command == 3) {
      got.bytes = text.substr(0, got.actual);
      text.erase(0, got.actual);
    }
    all.push_back(got);
  }
  EXPECT_EQ(text, "");
  return all;
}

class UsbIpTest : public ::testing::Test {
 protected:
  std::vector<Got> ask(const std::string& bytes, std::int64_t now_ns = 0, bool in = true) {
    return parse(usbip.exchange(bytes, now_ns), in);
  }
  family::SimulatedPokeys57u device{
      [](std::size_t input, std::int64_t) { return 100.0 + static_cast<double>(input); },
      family::SimulatedPokeys57u::Options{}};
  UsbIp usbip{device};
};

TEST_F(UsbIpTest, DescriptorsAreCutToTheRequestedLength) {
  auto got = ask(submit(7, 0, 18, bytes("80 06 00 01 00 00 12 00")));
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].command, 3u);
  EXPECT_EQ(got[0].number, 7u);
  EXPECT_EQ(got[0].status, 0);
  EXPECT_EQ(got[0].bytes, bytes("12 01 00 02 00 00 00 40 C3 1D 01 10 00 01 01 02 03 01"));
  got = ask(submit(8, 0, 9, bytes("80 06 00 02 00 00 09 00")));
  ASSERT_EQ(got[0].actual, 9u);
  const auto whole = static_cast<std::uint8_t>(got[0].bytes[2]);
  got = ask(submit(9, 0, 255, bytes("80 06 00 02 00 00 FF 00")));
  EXPECT_EQ(got[0].actual, whole);
  got = ask(submit(10, 0, 255, bytes("80 06 03 03 09 04 FF 00")));
  EXPECT_EQ(got[0].bytes.substr(2, 6), bytes("32 00 2E 00 31 00"));  // "2.1..."
  got = ask(submit(11, 0, 255, bytes("81 06 00 22 01 00 FF 00")));
  EXPECT_EQ(got[0].bytes, device.identity().hid_reports[1]);
}

TEST_F(UsbIpTest, UnknownRequestsStall) {
  const auto got = ask(submit(1, 0, 10, bytes("80 06 00 06 00 00 0A 00")));
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].status, -32);
  EXPECT_EQ(got[0].actual, 0u);
}

TEST_F(UsbIpTest, AReplyIsSentWhenItIsDue) {
  EXPECT_TRUE(ask(submit(1, 2, 64)).empty()) << "nothing is there yet";
  family::Frame asked = family::request(family::kEncoderValues);
  asked.id = 9;
  auto got = ask(submit(2, 2, 64, "", family::wrap(family::Way::request, asked), false), 0, false);
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].number, 2u);
  EXPECT_EQ(got[0].actual, 64u);
  EXPECT_TRUE(ask("", 500'000).empty());
  got = ask("", 1'000'000);
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].number, 1u);
  const auto reply = family::unwrap(family::Way::reply, got[0].bytes);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->id, 9);
  EXPECT_EQ(family::counts_of(*reply)[2], 102);
  EXPECT_TRUE(ask("", 2'000'000).empty());
}

TEST_F(UsbIpTest, EndpointsDoNotBlockEachOther) {
  EXPECT_TRUE(ask(submit(1, 1, 8) + submit(2, 2, 64) + submit(3, 2, 64) + submit(4, 3, 3)).empty());
  family::Frame asked = family::request(family::kTick);
  const std::string report = family::wrap(family::Way::request, asked);
  ask(submit(5, 2, 64, "", report, false) + submit(6, 2, 64, "", report, false), 0, false);
  const auto got = ask("", 5'000'000);
  ASSERT_EQ(got.size(), 2u);
  EXPECT_EQ(got[0].number, 2u) << "the earlier one gets the first report";
  EXPECT_EQ(got[1].number, 3u);
}

TEST_F(UsbIpTest, ATransferIsCancelledOnlyOnce) {
  EXPECT_TRUE(ask(submit(1, 2, 64)).empty());
  auto got = ask(unlink(2, 1));
  ASSERT_EQ(got.size(), 1u);
  EXPECT_EQ(got[0].command, 4u);
  EXPECT_EQ(got[0].number, 2u);
  EXPECT_EQ(got[0].status, -104);
  got = ask(unlink(3, 1));
  EXPECT_EQ(got[0].status, 0);
}

TEST_F(UsbIpTest, AcceptsBytesInAnyPieces) {
  const std::string report =
      family::wrap(family::Way::request, family::request(family::kDeviceData));
  const std::string all = submit(1, 2, 64) + submit(2, 2, 64, "", report, false);
  std::string answers;
  for (const char c : all) answers += usbip.exchange(std::string(1, c), 0);
  EXPECT_EQ(word_at(answers, 4), 2u);
  EXPECT_EQ(answers.size(), 48u);
  answers = usbip.exchange("", 1'000'000);
  EXPECT_EQ(answers.size(), 48u + 64u);
  EXPECT_FALSE(usbip.broken());
}

TEST_F(UsbIpTest, OtherProtocolsBreakTheConnection) {
  EXPECT_EQ(usbip.exchange(std::string(48, 'x'), 0), "");
  EXPECT_TRUE(usbip.broken());
  UsbIp huge(device);
  EXPECT_EQ(huge.exchange(submit(1, 2, 0x7FFFFFFF), 0), "");
  EXPECT_TRUE(huge.broken());
}

}  // namespace
}  // namespace mdof::simulate
