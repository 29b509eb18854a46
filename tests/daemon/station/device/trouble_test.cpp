#include "daemon/station/device/trouble.h"
#include "tests/shown.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mdof::daemon {
namespace {

using Kind = Trouble::Kind;

Trouble at(const char* time, Kind kind, const char* text, const char* device = "t7") {
  return {kind, device, text, std::string("2026-11-22T") + time + ".250Z"};
}

TEST(TroubleLog, ARecoveredDeviceIsOneLineWithItsCause) {
  TroubleLog log;
  log.add(at("14:02:11", Kind::lost, "no packet for 2 s"));
  log.add(at("14:02:14", Kind::back, "the device sends samples again after a break of 3.2 s"));
  EXPECT_EQ(test::shown(log.summary()),
            "device_trouble t7 kind=lost times=1 utc=2026-11-22T14:02:11.250Z reason=no packet for "
            "2 s end=the device sends samples again after a break of 3.2 s\n");
}

TEST(TroubleLog, ManyTroublesAreSummarised) {
  TroubleLog log;
  for (int i = 0; i < 150; ++i) {
    log.add(at("14:02:11", Kind::lost, "no route"));
    log.add(at("14:02:12", Kind::back, "the device sends samples again after a break of 0.1 s"));
  }
  log.add(at("14:05:00", Kind::lost, "no route"));
  log.add(at("14:05:01", Kind::suspect, "the encoder's datum is lost"));
  log.add(at("14:05:02", Kind::slow, "the device sends 1 of 10", "capa"));
  EXPECT_EQ(test::shown(log.summary()),
            "device_trouble t7 kind=lost times=151 utc=2026-11-22T14:02:11.250Z reason=no route "
            "end=the device had not recovered when the run ended\n"
            "device_trouble t7 kind=suspect times=1 utc=2026-11-22T14:05:01.250Z reason=the "
            "encoder's datum is lost end=\n"
            "device_trouble capa kind=slow times=1 utc=2026-11-22T14:05:02.250Z reason=the device "
            "sends 1 "
            "of 10 end=\n");
}

MeasuredPoint stop(std::vector<double> probe_m, std::vector<PointFlag> flags, bool valid) {
  MeasuredPoint point;
  point.point.position_m = 0.0125;
  point.point.probe_m = std::move(probe_m);
  point.point.flags = std::move(flags);
  point.errors.valid = valid;
  point.errors.reason = "five probes are needed";
  return point;
}

TEST(Unsolved, NamesProbesAndDeviceButNotTheConsequence) {
  const Rig rig = load_rig(std::string(MDOF_TEST_DATA) + "/five-probe/rig_X.toml").value();
  const ChannelsByDevice two = {{"capa", {"A", "B"}}, {"t7", {"encoder", "C", "D", "E"}}};
  const double nan = std::nan("");
  EXPECT_FALSE(unsolved(stop({0, 0, 0, 0, 0}, {}, true), rig, two, "now"));
  const auto of_one = unsolved(
      stop({nan, nan, 0, 0, 0}, {{Flag::lost, "A"}, {Flag::lost, "B"}}, false), rig, two, "now");
  ASSERT_TRUE(of_one);
  EXPECT_EQ(
      trouble_line(*of_one),
      "device \"capa\": unsolved: the stop at 12.500 mm has no error values: no usable readings "
      "from probe A, B");
  const auto of_both =
      unsolved(stop({nan, 0, nan, 0, 0},
                    {{Flag::lost, "A"}, {Flag::saturated, "C"}, {Flag::lost, "C"}}, false),
               rig, two, "now");
  EXPECT_EQ(trouble_line(*of_both),
            "unsolved: the stop at 12.500 mm has no error values: no usable readings from probe A; "
            "probe at the end of its range: C");
}

TEST(TroubleLog, NoTroubleGivesNoLine) {
  EXPECT_TRUE(TroubleLog().summary().empty());
}

TEST(JournalLimit, TheFirstMessageIsWrittenAtOnceAndAFloodIsCounted) {
  JournalLimit journal;
  JournalLimit::Time now{};
  EXPECT_EQ(journal.admit("a", "a: lost", now), "a: lost");
  EXPECT_EQ(journal.admit("b", "b: lost", now), "b: lost");
  for (int i = 0; i < 99; ++i) EXPECT_FALSE(journal.admit("a", "a: lost", now));
  now += std::chrono::seconds(11);
  EXPECT_EQ(journal.admit("a", "a: lost", now), "a: lost (and 99 more times before)");
  now += std::chrono::seconds(11);
  EXPECT_EQ(journal.admit("a", "a: lost", now), "a: lost");
}

}  // namespace
}  // namespace mdof::daemon
