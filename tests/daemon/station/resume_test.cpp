#include "daemon/station/resume.h"
#include "daemon/words/error_text.h"

#include <gtest/gtest.h>

#include <limits>

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

TEST(Continuation, AClockThatRestartedContinuesAfterTheRecording) {
  Continuation continuation(kEnd_ns);
  SampleBlock first = block("t7", 1'000'000), late = block("capa", 1'000'000 - 2'000'000'000),
              next = block("t7", 1'500'000);
  for (SampleBlock* b : {&first, &late, &next}) continuation.shift(*b);
  // The same shift applies to the device whose time stamps are 2 s earlier.
  EXPECT_GT(late.time_ns.front(), kEnd_ns);
  EXPECT_EQ(first.time_ns.front() - late.time_ns.front(), 2'000'000'000);
  EXPECT_EQ(next.time_ns.front() - first.time_ns.front(), 500'000);
  EXPECT_EQ(first.time_ns[1] - first.time_ns[0], 250'000);
}

TEST(Continuation, AClockThatContinuedIsNotShifted) {
  Continuation continuation(kEnd_ns);
  SampleBlock b = block("t7", kEnd_ns + 60'000'000'000);
  continuation.shift(b);
  EXPECT_EQ(b.time_ns.front(), kEnd_ns + 60'000'000'000);
}

// The old run ended before its first sample, so the recording has no end.
TEST(Continuation, AnEmptyRecordingShiftsNothing) {
  Continuation continuation(std::numeric_limits<std::int64_t>::min());
  SampleBlock b = block("t7", 9'778'038'002'052);
  continuation.shift(b);
  EXPECT_EQ(b.time_ns.front(), 9'778'038'002'052);
}

TEST(Continuation, EachDeviceReportsLostScansOnce) {
  Continuation continuation(kEnd_ns);
  std::vector<std::uint64_t> lost;
  for (const char* device : {"t7", "capa", "t7", "capa"}) {
    SampleBlock b = block(device, static_cast<std::int64_t>(lost.size()) * 1'000'000);
    continuation.shift(b);
    lost.push_back(b.lost);
  }
  EXPECT_EQ(lost, (std::vector<std::uint64_t>{1, 1, 0, 0}));
}

EncoderDatum datum(EncoderDatum::Kind kind, double offset_m) {
  return {kind, offset_m, "t7", "2026-11-23T07:00:00Z", "me"};
}

std::string why_not(const EncoderDatum& of_run, const EncoderDatum& now, bool counts_on) {
  const Status same = check_same_datum({7, "", of_run}, now, counts_on);
  return same ? "goes on" : words::text(same.error());
}

// After the datum is lost, positions are no machine positions and must not get the target numbers
// of the run.
TEST(SameDatum, ALostDatumMustBeSetAgainFirst) {
  using Kind = EncoderDatum::Kind;
  for (const Kind known : {Kind::set, Kind::configured}) {
    const std::string why = why_not(datum(known, 0.03), datum(Kind::none, 0), false);
    EXPECT_NE(why.find("run 7 cannot be continued"), std::string::npos) << why;
    EXPECT_NE(why.find("mdof encoder set"), std::string::npos) << why;
    EXPECT_NE(why.find("30 mm"), std::string::npos) << why;
    // After a user has set the position again, the offset may differ, because the positions are
    // machine positions again.
    EXPECT_EQ(why_not(datum(known, 0.03), datum(Kind::set, 0.04), false), "goes on");
  }
  EXPECT_EQ(why_not(datum(Kind::set, 0.03), datum(Kind::set, 0.03), true), "goes on");
}

TEST(SameDatum, WithoutADatumARunResumesOnlyInTheSameCount) {
  using Kind = EncoderDatum::Kind;
  const EncoderDatum none = datum(Kind::none, 0);
  EXPECT_EQ(why_not(none, none, true), "goes on");
  EXPECT_NE(why_not(none, none, false).find("start a new run"), std::string::npos);
  EXPECT_NE(why_not(none, datum(Kind::set, 0.01), true).find("start a new run"), std::string::npos);
  // A configured offset_mm is valid only for the count for which the user determined it.
  const EncoderDatum configured = datum(Kind::configured, 0.01);
  EXPECT_EQ(why_not(configured, configured, true), "goes on");
  EXPECT_NE(why_not(configured, configured, false).find("mdof encoder set"), std::string::npos);
}

TEST(SameDatum, AnAbsoluteEncoderResumesUnlessItsDatumWasSet) {
  const EncoderDatum absolute;
  EXPECT_EQ(why_not(absolute, absolute, true), "goes on");
  EXPECT_NE(why_not(absolute, datum(EncoderDatum::Kind::set, 0.01), true).find("start a new run"),
            std::string::npos);
  EXPECT_NE(why_not(datum(EncoderDatum::Kind::set, 0.01), absolute, true).find("encoder set"),
            std::string::npos);
}

}  // namespace
}  // namespace mdof::daemon
