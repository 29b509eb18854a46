// Data of a run for a separation: values of an error, or readings of one probe.
#include "algo/separation/run_series.h"

#include <gtest/gtest.h>

#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

// A run with δy = 2 µm/m · d and the yaw εz = 30 µrad/m · d at the travel d. At the fixture EYX is
// δy - d εz.
mdof::Run make_slope_run(const Rig& rig) {
  SyntheticRun synthetic{.rig = rig, .model = Model::exact, .targets_m = {0, 10e-3, 30e-3}};
  synthetic.truth = [](double d) { return Errors5{2e-6 * d, 0, 0, 0, 30e-6 * d}; };
  synthetic.u_reading_m = 10e-9;
  return synthetic.measure();
}

TEST(RunSeries, ErrorSeriesIsTheMeanAtEachTarget) {
  const auto run = make_slope_run(test::rig_x());
  const auto series = error_series(run, 0);
  ASSERT_EQ(series.position_m, (std::vector<double>{0, 10e-3, 30e-3}));
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = series.position_m[i];
    EXPECT_NEAR(series.error_m[i], 2e-6 * d - 30e-6 * d * d, 1e-13);
  }
}

// Probe D at x = 0 reads δy - εz d. Each target has two visits in each of three runs, so u of the
// mean is u/√6.
TEST(RunSeries, ProbeSeriesIsTheReading) {
  for (const char* id : {"D", "E"}) {
    const auto run = make_slope_run(test::rig_x());
    const std::size_t k = id[0] == 'D' ? 3 : 4;
    const ProbeSeries series = probe_series(run, test::rig_x(), id, Axis::y).value();
    EXPECT_EQ(series.position_m, (Vec3{k == 3 ? 0.0 : 10e-3, 15e-3, 20e-3}));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(series.set_up.error_m[i], run.points[i].point.probe_m[k], 1e-15) << id;
      EXPECT_NEAR(series.set_up.u_m[i], 10e-9 / std::sqrt(6.0), 1e-13) << id;
    }
  }
  auto run = make_slope_run(test::rig_x());
  const double before = probe_series(run, test::rig_x(), "D", Axis::y)->set_up.error_m[2];
  run.header.sides.fixture_moves = true;
  EXPECT_NEAR(probe_series(run, test::rig_x(), "D", Axis::y)->set_up.error_m[2], -before, 1e-18);
}

// The effect of a declared gain is compared with a run that has this gain: 2 % of probe D, or 2 %
// of probe B, which changes the roll.
TEST(RunSeries, DeclaredGainHasTheEffectOfARealGain) {
  for (const std::size_t k : {1u, 3u}) {
    const Rig rig = test::rig_x_with(k == 1 ? "B" : "D", "u_sensitivity_ppm = 20000");
    SyntheticRun synthetic{.rig = rig, .model = Model::exact, .targets_m = {0, 10e-3, 30e-3}};
    synthetic.truth = [](double d) { return Errors5{2e-6 * d, 1e-6 * d, 40e-6 * d, 0, 30e-6 * d}; };
    const auto run = synthetic.measure();
    synthetic.added = [k](std::size_t probe, double, double reading_m, double) {
      return probe == k ? 0.02 * reading_m : 0.0;
    };
    const auto with_gain = synthetic.measure();
    const auto declared = declared_shifts(run, rig, 0, Axis::y).value();
    ASSERT_EQ(declared.size(), 1U);
    EXPECT_NE(declared[0].common_as, "");
    const auto before = error_series(run, 0), after = error_series(with_gain, 0);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(declared[0].shift_m[i], after.error_m[i] - before.error_m[i], 1e-13) << k << i;
    EXPECT_GT(std::abs(declared[0].shift_m[2]), 1e-10);
    if (k == 1) continue;
    const auto own = probe_series(run, rig, "D", Axis::y)->set_up;
    ASSERT_EQ(own.declared.size(), 1U);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(own.declared[0].shift_m[i], 0.02 * own.error_m[i], 1e-18);
  }
}

// The flatness of the measured surface is a result of the separation and not part of u. The
// flatness of the other surface contributes to u.
TEST(RunSeries, UContainsFlatnessOfTheOtherSurfaceOnly) {
  const std::string planes =
      "[[plane]]\nid = \"side\"\nnormal = \"+Y\"\nu_flatness_um = 0.05\n"
      "[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n";
  const Rig side = test::rig_x_with("", "", planes);
  EXPECT_TRUE(declared_shifts(make_slope_run(side), side, 0, Axis::y)->empty());
  EXPECT_FALSE(declared_shifts(make_slope_run(side), side, 0, Axis::z)->empty());
}

// A plane without an id is recognised by its normal.
TEST(RunSeries, OmitsFlatnessOfThisSurfaceWithoutAnId) {
  const Rig side = test::rig_x_with("", "",
                                    "[[plane]]\nnormal = \"+Y\"\nu_flatness_um = "
                                    "0.05\n[[plane]]\nid = \"top\"\nnormal = \"+Z\"\n");
  EXPECT_TRUE(declared_shifts(make_slope_run(side), side, 0, Axis::y)->empty());
  EXPECT_FALSE(declared_shifts(make_slope_run(side), side, 0, Axis::z)->empty());
}

TEST(RunSeries, RejectsAProbeOfAnotherDirection) {
  const auto run = make_slope_run(test::rig_x());
  const auto other = probe_series(run, test::rig_x(), "A", Axis::y);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("probe \"A\" does not measure along Y"), std::string::npos);
  const auto none = probe_series(run, test::rig_x(), "Q", Axis::y);
  ASSERT_FALSE(none);
  EXPECT_NE(
      none.error().message.find("has no probe \"Q\"; the probes of this rig are A, B, C, D, E"),
      std::string::npos);
}

// u contains the sensitivity and the drift of the selected probe only. The drift is 0 at the start
// of the run.
TEST(RunSeries, ProbeHasItsOwnSensitivityAndDrift) {
  const Rig rig = test::rig_x_with("D", "u_sensitivity_ppm = 20000",
                                   "[drift]\nu_um_per_h = 3.6\n");  // 3.6 µm/h is 1 nm/s
  const auto run = make_slope_run(rig);
  for (const auto& [id, scales] :
       {std::pair("D", true), std::pair("E", false), std::pair("A", false)}) {
    const auto own = probe_series(run, rig, id, id[0] == 'A' ? Axis::z : Axis::y)->set_up;
    ASSERT_EQ(own.declared.size(), scales ? 2u : 1u) << id;
    for (std::size_t i = 0; i < 3; ++i) {
      if (scales) {
        EXPECT_NEAR(own.declared[0].shift_m[i], 0.02 * own.error_m[i], 1e-18);
      }
      // Six visits in intervals of ten seconds: forward at 10 i s, in reverse at 10 (5 - i) s; a
      // run takes 60 s.
      double mean_s = 0;
      for (int r = 0; r < 3; ++r)
        mean_s += (60.0 * r + 10 * static_cast<double>(i) + 60.0 * r +
                   10 * (5 - static_cast<double>(i))) /
                  6;
      EXPECT_NEAR(std::abs(own.declared.back().shift_m[i]), 1e-9 * mean_s, 1e-18) << id;
    }
  }
}

}  // namespace
}  // namespace mdof::algo
