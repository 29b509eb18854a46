// The dialogue of a program that reads real QSB-D: tmtsoftware/m1cs-qsb-linear-encoder-reader,
// QSBLinearEncoderReader/Qsb.cs. US Digital publishes no source.
#include <gtest/gtest.h>

#include <regex>

#include "drivers/qsb/device.h"

namespace mdof::drivers {
namespace {

struct Line {
  const char* command;
  const char* reply;  // what Qsb.cs accepts, as a regular expression
  const char* function;
};

TEST(QsbVectors, TheSimulatedOneAnswersWhatTmtsProgramAccepts) {
  QsbDevice device([](std::size_t, std::int64_t) { return 0; });
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
  // ParseEncoderCountStreamResponse: one line an interval of 1/512 s.
  const std::string stream = device.exchange(0, 1, "", 1'004'000'000);
  EXPECT_TRUE(std::regex_match(stream, std::regex("(s 0E [0-9A-F]{8} [0-9A-F]{8} !\r\n){2}")))
      << stream;
}

// ConnectionStatus.cs: serial number, type and firmware are bits 31-12, 11-8 and 7-0 of
// register 14.
TEST(QsbVectors, TheVersionIsReadAsTmtReadsIt) {
  const QsbIdentity id = qsb_identity(0x0BEEF012);
  EXPECT_EQ(id.serial, "0BEEF");
  EXPECT_EQ(id.model, "QSB-D");
  EXPECT_EQ(id.firmware, 0x12);
}

}  // namespace
}  // namespace mdof::drivers
