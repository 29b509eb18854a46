// Commands and replies of a program that reads real QSB-D devices:
// tmtsoftware/m1cs-qsb-linear-encoder-reader, QSBLinearEncoderReader/Qsb.cs. US Digital itself
// publishes no source.
#include <gtest/gtest.h>

#include <regex>

#include "drivers/qsb/simulated_qsb.h"

namespace mdof::drivers {
namespace {

struct Line {
  const char* command;
  const char* reply;  // regular expression that Qsb.cs accepts
  const char* function;
};

TEST(QsbVectors, SimulatedDeviceAnswersAsTmtsProgramAccepts) {
  SimulatedQsb device([](std::size_t, std::int64_t) { return 0; }, {});
  device.opened(0, 1, 1'000'000'000);
  const Line lines[] = {
      {"W150000000F", "w 15 0000000F [0-9A-F]{8} !\r\n", "WriteCommand"},
      {"R14", "r 14 [0-9A-F]{8} [0-9A-F]{8} !\r\n", "ReadCommand"},
      {"W0300000003", "w 03 00000003 [0-9A-F]{8} !\r\n", "WriteCommand"},
      {"W0400000000", "w 04 00000000 [0-9A-F]{8} !\r\n", "WriteCommand"},
      {"W0B00000000", "w 0B 00000000 [0-9A-F]{8} !\r\n", "WriteCommand"},
      {"W0C00000001", "w 0C 00000001 [0-9A-F]{8} !\r\n", "WriteCommand"},
      {"W0D00000001", "w 0D 00000001 [0-9A-F]{8} !\r\n", "WriteCommand"},
      {"S0E", "s 0E [0-9A-F]{8} [0-9A-F]{8} !\r\n", "StreamCommand"},
  };
  for (const Line& line : lines) {
    const std::string reply =
        device.exchange(0, 1, std::string(line.command) + "\r\n", 1'000'000'000);
    EXPECT_TRUE(std::regex_match(reply, std::regex(line.reply)))
        << line.command << " -> " << reply << " (Qsb.cs, " << line.function << ")";
  }
  // ParseEncoderCountStreamResponse: the device sends one line each 1/512 s.
  const std::string stream = device.exchange(0, 1, "", 1'004'000'000);
  EXPECT_TRUE(std::regex_match(stream, std::regex("(s 0E [0-9A-F]{8} [0-9A-F]{8} !\r\n){2}")))
      << stream;
}

// The QSB writes its registers 03 and 08 to its counter, an LS7366R.
// - QSB Command List v1.28, MDR0: "Sync Index, Reset on Index, Free Running, X4 mode, W0363"
// - MikroElektronika/mikrosdk_click_v2, clicks/counter/lib_counter/include/counter.h:
//   COUNTER_INDEX_LOAD_CNTR 0x10, COUNTER_INDEX_RESET_CNTR 0x20, COUNTER_4X_QUAD 0x03
// - the same file, counter_write_dtr: the index loads DTR into the counter
TEST(QsbVectors, IndexLoadsTheCounter) {
  constexpr std::uint32_t kSyncResetX4 = 0x63, kReset = 0x20, kLoad = 0x10;
  EXPECT_EQ(qsb::kIndexLoads, kLoad);
  EXPECT_EQ(3 | qsb::kIndexSynchronous | qsb::kIndexLoads, kSyncResetX4 - kReset + kLoad);
  double position = 100;
  SimulatedQsb device([&](std::size_t, std::int64_t) { return position; }, {});
  device.set_mark({150});
  device.opened(0, 1, 1'000'000'000);
  const auto ask = [&](const std::string& command) {
    return device.exchange(0, 1, command + "\r\n", 1'000'000'000);
  };
  ask("W150000000B");  // switches time stamps off
  ask("W08000001F3");  // 499, the example of the command list
  ask("W0353");
  EXPECT_EQ(ask("R0E"), "r 0E 00000064 !\r\n");
  position = 160;
  EXPECT_EQ(ask("R0E"), "r 0E 000001FD !\r\n");  // 499 + 10
  ask("W0303");
  position = 140;
  EXPECT_EQ(ask("R0E"), "r 0E 000001E9 !\r\n");
}

// ConnectionStatus.cs: in register 14, bits 31-12 are the serial number, bits 11-8 the type and
// bits 7-0 the firmware.
TEST(QsbVectors, ReadsTheVersionAsTmtDoes) {
  const QsbIdentity id = qsb_identity(0x0BEEF012);
  EXPECT_EQ(id.serial, "0BEEF");
  EXPECT_EQ(id.model, "QSB-D");
  EXPECT_EQ(id.firmware, 0x12);
  EXPECT_EQ(qsb::kPowerWasLost, 1U << 2);
  EXPECT_EQ(qsb_identity(0x0BEEF212).model, "QSB-S");
  EXPECT_EQ(qsb_identity(0x0BEEF312).model, "QSB");  // this type is unknown
}

}  // namespace
}  // namespace mdof::drivers
