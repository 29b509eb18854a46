// Commands, replies and the data header that a client of real controllers uses:
// epics-modules/microEpsilon, capaNCDT6200Sup. Micro-Epsilon itself publishes no source.
#include <gtest/gtest.h>

#include <regex>

#include "drivers/capancdt/replies.h"
#include "drivers/capancdt/simulated_capancdt.h"
#include "tests/drivers/vendor_vector.h"

namespace mdof::drivers::capancdt {
namespace {

SimulatedCapancdt controller() {
  SimulatedCapancdt::Options options;
  // The controller sends the reply only once, as the client expects.
  options.faults.echo = SimulatedCapancdt::Echo::reply;
  return {[](std::size_t, std::int64_t) { return 1000; }, options};
}

struct Line {
  const char* command;
  const char* in;  // regular expression from Db/capaNCDT6200.proto
};

TEST(CapancdtVectors, SimulatedDeviceAnswersAsEpicsReads) {
  SimulatedCapancdt device = controller();
  device.opened(0, 1, 0);
  device.exchange(0, 1, "", 0);  // reads the welcome text
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

// Header according to src/capaNCDT6200Sup.c, little-endian:
// - bytes 0 to 3: "MEAS" in reverse order
// - byte 4: order number
// - byte 8: serial number
// - byte 12: channels
// - byte 20: status
// - bytes 24 and 26: two sizes
// - byte 28: counter
// - byte 32 and following: values; 0xFFFFFF is the whole range (capaNCDT6200Protocol.h)
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
