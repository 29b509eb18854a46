// Checks the bytes of the simulated T7, without sockets.
#include "drivers/labjack_t7/simulated_labjack_t7.h"

#include <gtest/gtest.h>

#include "tests/drivers/modbus/hex.h"

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr std::size_t kCommand = 0, kStream = 1;
constexpr std::int64_t kMs = 1'000'000;

// AIN0 ... AIN4 have the values of the read vectors. The counter counts 1000 counts/ms.
double senses(std::size_t input, std::int64_t t_ns) {
  constexpr double kVolts[] = {1.0, -2.5, 0.125, 9.75, -10.0};
  if (input < 5) return kVolts[input];
  return input >= SimulatedLabjackT7::kCounterInput ? -65536.0 + static_cast<double>(t_ns) / 1000
                                                    : 0;
}

class LabjackT7Device : public testing::Test {
 protected:
  std::string ask(const char* hex) { return device.exchange(kCommand, 1, modbus::bytes(hex), now); }
  std::string write(int address, Words words) {
    std::string bytes = modbus::bytes("00 09 00 00 00 0B 01 10");
    for (const int byte : {address >> 8, address & 0xFF, 0, 2, 4, words[0] >> 8, words[0] & 0xFF,
                           words[1] >> 8, words[1] & 0xFF})
      bytes += static_cast<char>(byte);
    return device.exchange(kCommand, 1, bytes, now);
  }
  void start(float rate, std::uint32_t samples, std::initializer_list<std::uint32_t> list) {
    write(4002, words_of_float(rate));
    write(4004, words_of(static_cast<std::uint32_t>(list.size())));
    write(4006, words_of(samples));
    int address = 4100;
    for (const std::uint32_t entry : list)
      write(std::exchange(address, address + 2), words_of(entry));
    write(43900, words_of_float(10));
    count_by(0);
    device.opened(kStream, 2, now);
    EXPECT_EQ(write(4990, words_of(1)), modbus::bytes("00 09 00 00 00 06 01 10 13 7E 00 02"));
  }
  void count_by(int line) {
    for (const int n : {line, line + 1}) {
      write(44100 + 2 * n, words_of(kQuadrature));
      write(44000 + 2 * n, words_of(1));
    }
  }
  std::vector<StreamPacket> packets() {
    reader.append(device.exchange(kStream, 2, "", now));
    std::vector<StreamPacket> all;
    StreamPacket p;
    while (reader.next(p).value()) all.push_back(p);
    return all;
  }

  SimulatedLabjackT7 device{senses, {}};
  PacketReader reader;
  std::int64_t now = 5'000'000'000;
};

TEST_F(LabjackT7Device, AnswersTheReadVectors) {
  count_by(0);
  EXPECT_EQ(
      ask("00 01 00 00 00 06 01 03 00 00 00 0A"),
      modbus::bytes("00 01 00 00 00 17 01 03 14 3F800000 C0200000 3E000000 411C0000 C1200000"));
  EXPECT_EQ(ask("00 02 00 00 00 06 01 03 D7 3C 00 02"),
            modbus::bytes("00 02 00 00 00 07 01 03 04 00 11 22 33"));
  now = 65'536'000 + 7'000;  // the count is 7
  EXPECT_EQ(ask("00 03 00 00 00 06 01 03 0B B8 00 02"),
            modbus::bytes("00 03 00 00 00 07 01 03 04 00 00 00 07"));
}

TEST_F(LabjackT7Device, AcceptsTheWriteVectors) {
  const char* const vectors[][3] = {{"00 04 00 00 00 0B 01 10 AB 7C 00 02 04 41 20 00 00",
                                     "00 04 00 00 00 06 01 03 AB 7C 00 02", "41 20 00 00"},
                                    {"00 05 00 00 00 0B 01 10 AC 44 00 02 04 00 00 00 0A",
                                     "00 05 00 00 00 06 01 03 AC 44 00 02", "00 00 00 0A"},
                                    {"00 06 00 00 00 0B 01 10 0F A2 00 02 04 44 7A 00 00",
                                     "00 06 00 00 00 06 01 03 0F A2 00 02", "44 7A 00 00"}};
  for (const auto& v : vectors) {
    const std::string echo = modbus::bytes(v[0]).substr(0, 12);
    EXPECT_EQ(ask(v[0]).substr(6), modbus::bytes("01 10") + echo.substr(8, 4));
    EXPECT_EQ(ask(v[1]).substr(9), modbus::bytes(v[2]));
  }
}

TEST_F(LabjackT7Device, WriteVectorsStartAStream) {
  start(1000, 7, {0, 2, 4, 6, 8, 3000, 4899});
  EXPECT_EQ(ask("00 07 00 00 00 0B 01 10 13 7E 00 02 04 00 00 00 01"),
            modbus::bytes("00 07 00 00 00 03 01 90 04"));  // a stream is already running
  EXPECT_EQ(ask("00 08 00 00 00 06 01 03 D6 D8 00 01"),
            modbus::bytes("00 08 00 00 00 05 01 03 02 0A 2D"));  // error 2605
  now += 3 * kMs;
  const auto all = packets();
  ASSERT_EQ(all.size(), 2U);
  EXPECT_EQ(all[1].transaction, 1);
  EXPECT_EQ(all[1].samples.size(), 7U);
  EXPECT_NEAR(labjack::volts(SimulatedLabjackT7::calibration(0), all[1].samples[1]), -2.5, 2e-4);
}

TEST_F(LabjackT7Device, RequestsMayArriveInPieces) {
  const std::string request = modbus::bytes("00 02 00 00 00 06 01 03 D7 3C 00 02");
  for (std::size_t i = 0; i + 1 < request.size(); ++i)
    EXPECT_EQ(device.exchange(kCommand, 1, request.substr(i, 1), now), "");
  EXPECT_EQ(device.exchange(kCommand, 1, request.substr(11), now).size(), 13U);
}

TEST_F(LabjackT7Device, RefusesWithModbusExceptions) {
  EXPECT_EQ(ask("00 01 00 00 00 06 01 04 00 00 00 02"),
            modbus::bytes("00 01 00 00 00 03 01 84 01"));
  EXPECT_EQ(ask("00 01 00 00 00 06 01 03 23 28 00 02"),
            modbus::bytes("00 01 00 00 00 03 01 83 02"));
  EXPECT_EQ(ask("00 01 00 00 00 06 01 03 00 00 00 00"),
            modbus::bytes("00 01 00 00 00 03 01 83 03"));
  EXPECT_EQ(ask("00 01 00 00 00 06 01 06 AB 7E 00 C7"),
            modbus::bytes("00 01 00 00 00 06 01 06 AB 7E 00 C7"));
  EXPECT_EQ(write(4990, words_of(0)).substr(7), modbus::bytes("90 04"));  // no stream is running
  // Error 2620.
  EXPECT_EQ(ask("00 08 00 00 00 06 01 03 D6 D8 00 01").substr(9), modbus::bytes("0A 3C"));
}

TEST_F(LabjackT7Device, SwapsWordsOnRequest) {
  SimulatedLabjackT7::Faults faults;
  faults.swapped_words = true;
  device.set_faults(faults);
  EXPECT_EQ(ask("00 02 00 00 00 06 01 03 D7 3C 00 02").substr(9), modbus::bytes("22 33 00 11"));
}

// T-Series Datasheet 13.2.9: DIO_EF_READ_A of line n is at address 3000 + 2 n.
TEST_F(LabjackT7Device, OnlyConfiguredPairsOfLinesCount) {
  // High word of the count at an address. All its bits are 1 if the count is negative.
  const auto high = [&](const char* address) {
    return ask((std::string("00 01 00 00 00 06 01 03 ") + address + " 00 02").c_str()).substr(9, 2);
  };
  now = 1'000'000;
  EXPECT_EQ(high("0B BC"), modbus::bytes("00 00"));  // 3004: DIO2
  count_by(2);
  EXPECT_EQ(high("0B BC"), modbus::bytes("FF FF"));
  EXPECT_EQ(high("0B C4"), modbus::bytes("00 00"));  // 3012: DIO6
  count_by(6);
  EXPECT_EQ(high("0B C4"), modbus::bytes("FF FF"));
  EXPECT_EQ(high("0B B8"), modbus::bytes("00 00"));  // 3000: DIO0
}

// In each scan, the count changes from 0xFFFF to 0x10000 after the lower word and before the upper
// word is read.
double at_a_boundary(std::size_t input, std::int64_t t_ns) {
  return input == SimulatedLabjackT7::kCounterInput && t_ns % kMs < 15'000 ? 65535 : 65536;
}

TEST_F(LabjackT7Device, UpperAndLowerWordBelongToTheSameCount) {
  // Control: without capture, the two words must not fit together.
  for (const bool captured : {true, false}) {
    device = SimulatedLabjackT7(at_a_boundary, {});
    SimulatedLabjackT7::Faults faults;
    faults.no_capture = !captured;
    device.set_faults(faults);
    start(1000, 3, {0, 3000, 4899});
    now += 2 * kMs;
    const auto all = packets();
    ASSERT_EQ(all.size(), 1U);
    EXPECT_EQ(u32_of(all[0].samples[2], all[0].samples[1]), captured ? 65535U : 131071U);
  }
}

TEST_F(LabjackT7Device, CoreTimerCountsAt40MHzAndStampsTheFirstScan) {
  const auto core = [&] {
    const std::string r = ask("00 01 00 00 00 06 01 03 F0 50 00 02");
    return u32_of(static_cast<std::uint16_t>(static_cast<std::uint8_t>(r[9]) << 8 |
                                             static_cast<std::uint8_t>(r[10])),
                  static_cast<std::uint16_t>(static_cast<std::uint8_t>(r[11]) << 8 |
                                             static_cast<std::uint8_t>(r[12])));
  };
  const std::uint32_t before = core();
  now += kMs;
  EXPECT_EQ(core() - before, 40'000U);
  // LabJack's ljm_constants.json: the time stamp is taken "At the start of the first stream scan".
  // This is one period after the start.
  start(1000, 1, {0});
  const auto stamp = [&] { return ask("00 01 00 00 00 06 01 03 0F BA 00 02").substr(9); };
  EXPECT_EQ(stamp(), modbus::bytes("00 00 00 00"));
  now += kMs;
  const Words words = words_of(before + 80'000);
  EXPECT_EQ(stamp(), (std::string{static_cast<char>(words[0] >> 8), static_cast<char>(words[0]),
                                  static_cast<char>(words[1] >> 8), static_cast<char>(words[1])}));
}

}  // namespace
}  // namespace mdof::drivers::labjack_t7
