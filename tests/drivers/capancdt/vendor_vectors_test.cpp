// Commands, replies and the data header of a client that reads real controllers:
// epics-modules/microEpsilon, capaNCDT6200Sup. Micro-Epsilon publishes no source.
#include <gtest/gtest.h>

#include <regex>

#include "drivers/capancdt/replies.h"
#include "drivers/capancdt/simulated_capancdt.h"
#include "tests/drivers/vendor_vector.h"

namespace mdof::drivers::capancdt {
namespace {

SimulatedCapancdt controller() {
  SimulatedCapancdt::Options options;
  options.faults.echo = SimulatedCapancdt::Echo::reply;  // a single reply, as the client reads it
  return {[](std::size_t, std::int64_t) { return 1000; }, options};
}

struct Line {
  const char* command;
  const char* in;  // from Db/capaNCDT6200.proto, as a regular expression
};

TEST(CapancdtVectors, SimulatedDeviceAnswersAsEpicsReads) {
  SimulatedCapancdt device = controller();
  device.opened(0, 1, 0);
  device.exchange(0, 1, "", 0);  // the welcome text
  const Line lines[] = {
      {"$VER", R"(\$VER[^;]+;.*)"},
      {"$STI?", R"(\$STI\?\d+OK)"},
      {"$STI1200", R"(\$STI1200,\d+OK)"},
      {"$TRG?", R"(\$TRG\?\dOK)"},
      {"$TRG0", R"(\$TRG0OK)"},
      {"$AVT?", R"(\$AVT\?\dOK)"},
      {"$AVT2", R"(\$AVT2OK)"},
      {"$AVN?", R"(\$AVN\?\dOK)"},
      {"$AVN8", R"(\$AVN8OK)"},
      {"$CHS", R"(\$CHS\d,\d,\d,\dOK)"},
      {"$CHI1", R"(\$CHI1:ANO\d+,NAM[^,\s]+,SNO\d+,OFS\d+,RNG\d+,UNT[^OK]+OK)"},
      {"$LIN?", R"(\$LIN\?\d,\d,\d,\dOK)"},
      {"$ALP?", R"(\$ALP\?\dOK)"},
      {"$GDP", R"(\$GDP\d+OK)"},
  };
  for (const Line& line : lines) {
    const std::string reply = device.exchange(0, 1, std::string(line.command) + "\r", 0);
    EXPECT_TRUE(std::regex_match(reply, std::regex(std::string(line.in) + "\r\n")))
        << line.command << " -> " << reply << " (capaNCDT6200.proto)";
    EXPECT_TRUE(find_reply(line.command, reply)) << line.command;
  }
}

// src/capaNCDT6200Sup.c: bytes 0 to 3 reversed are "MEAS", order number at byte 4, serial number at
// 8, channels at 12, status at 20, two sizes at 24 and 26, counter at 28, values from 32 on, all
// little-endian; 0xFFFFFF is the whole range (capaNCDT6200Protocol.h).
TEST(CapancdtVectors, PacketHasTheOffsetsThatEpicsReads) {
  SimulatedCapancdt device = controller();
  device.opened(1, 2, 0);
  const std::string packet = device.exchange(1, 2, "", 1'000'000);
  EXPECT_EQ(mismatch(packet,
                     "53 41 45 4D 31 24 23 00 E9 03 00 00 55 00 00 00 00 00 00 00 00 00 00 00 10 "
                     "00 01 00 00 00 00 00 00 00 80 00 00 00 80 00 00 00 80 00 00 00 80 00"),
            "");
}

}  // namespace
}  // namespace mdof::drivers::capancdt
