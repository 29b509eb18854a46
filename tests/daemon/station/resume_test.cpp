#include "daemon/station/resume.h"

#include <gtest/gtest.h>

namespace mdof::daemon {
namespace {

constexpr std::int64_t kEnd_ns = 9'000'000'000'000;

SampleBlock block(const std::string& device, std::int64_t first_ns) {
  SampleBlock b;
  b.device = device;
  b.channels = {{"encoder", Unit::um}};
  b.time_ns = {first_ns, first_ns + 250'000};
  b.value = {{1, 2}};
  return b;
}

TEST(Continuation, AClockThatBeganAnewGoesOnAfterTheRecording) {
  Continuation continuation(kEnd_ns);
  SampleBlock first = block("t7", 1'000'000), late = block("capa", 1'000'000 - 2'000'000'000),
              next = block("t7", 1'500'000);
  for (SampleBlock* b : {&first, &late, &next}) continuation.shift(*b);
  EXPECT_GT(late.time_ns.front(), kEnd_ns);  // a device that lies behind as well
  EXPECT_EQ(first.time_ns.front() - late.time_ns.front(), 2'000'000'000);
  EXPECT_EQ(next.time_ns.front() - first.time_ns.front(), 500'000);
  EXPECT_EQ(first.time_ns[1] - first.time_ns[0], 250'000);
}

TEST(Continuation, AClockThatWentOnIsLeftAlone) {
  Continuation continuation(kEnd_ns);
  SampleBlock b = block("t7", kEnd_ns + 60'000'000'000);
  continuation.shift(b);
  EXPECT_EQ(b.time_ns.front(), kEnd_ns + 60'000'000'000);
}

TEST(Continuation, EachDeviceSaysOnceThatScansWereLost) {
  Continuation continuation(kEnd_ns);
  std::vector<std::uint64_t> lost;
  for (const char* device : {"t7", "capa", "t7", "capa"}) {
    SampleBlock b = block(device, static_cast<std::int64_t>(lost.size()) * 1'000'000);
    continuation.shift(b);
    lost.push_back(b.lost);
  }
  EXPECT_EQ(lost, (std::vector<std::uint64_t>{1, 1, 0, 0}));
}

}  // namespace
}  // namespace mdof::daemon
