// Tests the texts about a drift. Each number is calculated by hand.
#include "algo/drift/drift_sentences.h"

#include <gtest/gtest.h>

#include "tests/algo/rigs.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

// A log of 3 min. δy changes by +0.25 µm and εz by -5 µrad because of a drift. δz changes by +0.5
// µm, which may be steps.
RunDrift three_changes() {
  RunDrift drift;
  drift.length_s = 180;
  const auto set = [&](std::size_t local, double change, double u, bool steps) {
    SeriesDrift& of = drift.errors[local];
    of.order = 1;
    of.change = change;
    of.u_change = u;
    of.range = std::abs(change);
    of.steps = steps;
  };
  set(kDy, 0.25e-6, 4e-9, false);
  set(kEz, -5e-6, 0.12e-6, false);
  set(kDz, 0.5e-6, 3e-9, true);
  return drift;
}

TEST(DriftSentences, NameEachErrorOfTheMovingBody) {
  const RunDrift drift = three_changes();
  EXPECT_EQ(changes_text(drift, {Axis::x, {}}, false),
            "EYX +0.2500 ± 0.0040 µm, ECX -5.00 ± 0.12 µrad from the first point to the last "
            "(3 min)");
  EXPECT_EQ(changes_text(drift, {Axis::x, {}}, true),
            "EZX +0.5000 ± 0.0030 µm from the first point to the last (3 min)");
  // If the fixture moves, the sign is opposite. For a run along Y, EXY is -δy.
  const Sides fixture{.fixture_moves = true};
  EXPECT_EQ(changes_text(drift, {Axis::x, fixture}, false).substr(0, 24), "EYX -0.2500 ± 0.0040 µ");
  EXPECT_EQ(changes_text(drift, {Axis::y, {}}, false).substr(0, 11), "EXY -0.2500");
  EXPECT_EQ(changes_text(RunDrift{}, {Axis::x, {}}, false), "");
}

// GUM 7.2.6: u has two significant digits, also if its rounding adds a digit.
TEST(DriftSentences, RoundToTwoDigitsOfU) {
  const auto said = [](double change_m, double u_m) {
    RunDrift drift = three_changes();
    drift.errors[kEz] = {};
    drift.errors[kDy].change = change_m;
    drift.errors[kDy].u_change = u_m;
    const std::string text = changes_text(drift, {Axis::x, {}}, false);
    return text.substr(0, text.find(" from"));
  };
  EXPECT_EQ(said(0.25049e-6, 0.0317e-6), "EYX +0.250 ± 0.032 µm");
  EXPECT_EQ(said(-1.23456e-6, 0.0996e-6), "EYX -1.23 ± 0.10 µm");
  EXPECT_EQ(said(1.23449e-6, 0.099e-6), "EYX +1.234 ± 0.099 µm");
  EXPECT_EQ(said(1.23456e-6, 0.00071234e-6), "EYX +1.23456 ± 0.00071 µm");
  EXPECT_EQ(said(321.4e-6, 12.3e-6), "EYX +321 ± 12 µm");
  EXPECT_EQ(said(4321.4e-6, 123.4e-6), "EYX +4320 ± 120 µm");
}

TEST(DriftSentences, ReportRemovedAndRemainingDrifts) {
  RunDrift drift = three_changes();
  const std::string both = test::shown(removal_notices(drift, {Axis::x, {}}));
  EXPECT_EQ(both.find("drift_removed changes=EYX +0.2500"), 0U) << both;
  EXPECT_NE(both.find("\nsteps_not_removed changes=EZX +0.5000"), std::string::npos) << both;
  EXPECT_EQ(
      test::shown(removal_notices(RunDrift{}, {Axis::x, {}})),
      "drift_not_removed reason=no drift can be distinguished from noise, steps and a variation "
      "whose period is about the duration of one run\n");
  drift.not_seen = "too few";
  EXPECT_EQ(test::shown(removal_notices(drift, {Axis::x, {}})),
            "drift_not_removed reason=too few\n");
}

// Changes of 0.1 and 0.3 µm in 3 min are drifts of 2 and 6 µm/h.
TEST(DriftSentences, NameTheProbesAboveTheLimit) {
  RunDrift drift = three_changes();
  const Rig rig = test::rig_x_with("", "", "[drift]\nlimit_um_per_h = 4\n");
  for (const double range_m : {0.1e-6, 0.3e-6}) {
    SeriesDrift& of = drift.probes.emplace_back();
    of.order = 1;
    of.range = range_m;
  }
  EXPECT_EQ(test::shown(over_limit(drift, rig)),
            "drift_over_limit B rate_um_per_h=6 limit_um_per_h=4\n");
  EXPECT_EQ(test::shown(over_limit(drift, test::rig_x())), "");
  drift.length_s = 0.5;  // a short log: 0.3 µm in half a second
  EXPECT_EQ(test::shown(over_limit(drift, rig)).substr(0, 19), "drift_over_limit A ");
  ASSERT_EQ(over_limit(drift, rig).size(), 2u);
  EXPECT_NEAR(test::number(over_limit(drift, rig)[1], "rate_um_per_h"), 2160, 1e-9);
  drift.length_s = 0;
  EXPECT_EQ(test::shown(over_limit(drift, rig)), "");
  drift.length_s = 180;
  drift.probes[1].order = 0;
  EXPECT_EQ(test::shown(over_limit(drift, rig)), "");
}

// The local error εx is EAX for a run along X and EBY for a run along Y. Each of the five errors
// has its own sign and size.
TEST(DriftSentences, NameAllFiveErrors) {
  RunDrift drift;
  drift.length_s = 60;
  const double changes[] = {1e-6, 2e-6, 3e-6, 4e-6, 5e-6};  // two in m, three in rad
  for (std::size_t k = 0; k < 5; ++k) {
    drift.errors[k].order = 1;
    drift.errors[k].change = changes[k];
    drift.errors[k].u_change = 0.1e-6;
  }
  const std::string end = " from the first point to the last (1 min)";
  EXPECT_EQ(changes_text(drift, {Axis::x, {}}, false),
            "EYX +1.00 ± 0.10 µm, EZX +2.00 ± 0.10 µm, EAX +3.00 ± 0.10 µrad, EBX +4.00 ± 0.10 "
            "µrad, ECX +5.00 ± 0.10 µrad" +
                end);
  EXPECT_EQ(changes_text(drift, {Axis::x, {.fixture_moves = true}}, false),
            "EYX -1.00 ± 0.10 µm, EZX -2.00 ± 0.10 µm, EAX -3.00 ± 0.10 µrad, EBX -4.00 ± 0.10 "
            "µrad, ECX -5.00 ± 0.10 µrad" +
                end);
  // For a run along Y, the machine axis X is -y and the machine axis Y is x of the local frame: EXY
  // = -δy, EAY (about X) = -εy, EBY (about Y) = εx.
  EXPECT_EQ(changes_text(drift, {Axis::y, {}}, false),
            "EXY -1.00 ± 0.10 µm, EZY +2.00 ± 0.10 µm, EAY -4.00 ± 0.10 µrad, EBY +3.00 ± 0.10 "
            "µrad, ECY +5.00 ± 0.10 µrad" +
                end);
}

}  // namespace
}  // namespace mdof::algo
