// The simulated controller, called without sockets.
#include "drivers/capancdt/simulated_capancdt.h"

#include <gtest/gtest.h>

namespace mdof::drivers::capancdt {
namespace {

constexpr std::size_t kCommand = 0, kData = 1;
constexpr std::int64_t kSecond = 1'000'000'000;

double half(std::size_t, std::int64_t) {
  return 1000;
}

std::string asked(SimulatedCapancdt& device, const std::string& text, std::int64_t now_ns = 0) {
  return device.exchange(kCommand, 1, text, now_ns);
}

TEST(CapancdtDevice, AnswersAsTheManualStates) {
  SimulatedCapancdt device(half, {});
  device.opened(kCommand, 1, 0);
  EXPECT_EQ(asked(device, ""), "Welcome\r\nDevice: DT6220\r\nSerial number: 1001\r\n");
  EXPECT_EQ(asked(device, "$STI1200\r"), "$STI1200\r$STI1200,1024OK\r\n");
  EXPECT_EQ(asked(device, "$STI1000\r\n"), "$STI1000\r$STI1000,960OK\r\n");
  EXPECT_EQ(asked(device, "$STI?\r"), "$STI?\r$STI?960OK\r\n");
  EXPECT_EQ(asked(device, "nonsense$CHS\r"), "$CHS\r$CHS1,1,1,1OK\r\n");
  EXPECT_EQ(asked(device, "$GDP\r"), "$GDP\r$GDP10001OK\r\n");
  EXPECT_EQ(asked(device, "$VER\r"), "$VER\r$VERDT6220;V1.2a;8010079\r\n");
  EXPECT_EQ(asked(device, "$XYZ\r"), "$XYZ\r$UNKNOWN COMMAND\r\n");
  EXPECT_EQ(asked(device, "$AVN4\r$AVN?\r"), "$AVN4\r$AVN4OK\r\n$AVN?\r$AVN?4OK\r\n");
}

TEST(CapancdtDevice, ForgetsAHalfTypedCommandAfterTenSeconds) {
  SimulatedCapancdt device(half, {});
  device.opened(kCommand, 1, 0);
  asked(device, "$ST");
  EXPECT_EQ(asked(device, "I?\r", 9 * kSecond), "$STI?\r$STI?960OK\r\n");
  asked(device, "$ST", 10 * kSecond);
  EXPECT_EQ(asked(device, "I?\r", 21 * kSecond), "");
}

TEST(CapancdtDevice, StreamsToOneClientOnly) {
  SimulatedCapancdt device(half, {});
  device.opened(kData, 1, 0);
  device.opened(kData, 2, 0);
  const std::string bytes = device.exchange(kData, 1, "", 10'000'000);
  EXPECT_EQ(bytes.size(), 10u * (32 + 16));  // one packet each 960 us
  EXPECT_EQ(device.exchange(kData, 2, "", 10'000'000), "");
  device.closed(kData, 1);
  device.opened(kData, 3, kSecond);
  EXPECT_EQ(device.exchange(kData, 3, "", kSecond + 1'000'000).size(), 48u);
}

TEST(CapancdtDevice, SendsTheSignalsOfItsInputs) {
  SimulatedCapancdt::Options options;
  options.frames_per_packet = 2;
  options.inputs[1].present = false;
  const auto ramps = [](std::size_t input, std::int64_t t_ns) {
    return static_cast<double>(input) * 100 + static_cast<double>(t_ns) / 960e3;
  };
  SimulatedCapancdt device(ramps, options);
  device.opened(kData, 1, 0);
  PacketParser parser;
  parser.add(device.exchange(kData, 1, "", 2'000'000));
  Packet packet;
  ASSERT_TRUE(parser.next(packet));
  EXPECT_EQ(packet.channel_bits, 0x51u);
  ASSERT_EQ(packet.values.size(), 6u);
  const double um[] = {1, 201, 301, 2, 202, 302};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(to_um(packet.values[i], 2000), um[i], 1e-4);
}

TEST(CapancdtDevice, SendsNothingWhileTriggered) {
  SimulatedCapancdt::Options options;
  options.trigger = 1;
  SimulatedCapancdt device(half, options);
  device.opened(kData, 1, 0);
  EXPECT_EQ(device.exchange(kData, 1, "", kSecond), "");
}

}  // namespace
}  // namespace mdof::drivers::capancdt
