// What a separation takes of a run: the error itself, or one probe's own readings.
#include "algo/separation/run_series.h"

#include <gtest/gtest.h>

#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/synthetic_run.h"

namespace mdof::algo {
namespace {

// δy of 2 µm/m and a yaw of 30 µrad/m: at the fixture EYX = δy - d εz.
mdof::Run of_slopes(const Rig& rig) {
  SyntheticRun synthetic{.rig = rig, .model = Model::exact, .targets_m = {0, 10e-3, 30e-3}};
  synthetic.truth = [](double d) { return Errors5{2e-6 * d, 0, 0, 0, 30e-6 * d}; };
  synthetic.u_reading_m = 10e-9;
  return synthetic.measure();
}

TEST(RunSeries, OfAnErrorIsItsMeanAtEachTarget) {
  const auto run = of_slopes(test::rig_x());
  const auto series = error_series(run, 0);
  ASSERT_EQ(series.position_m, (std::vector<double>{0, 10e-3, 30e-3}));
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = series.position_m[i];
    EXPECT_NEAR(series.error_m[i], 2e-6 * d - 30e-6 * d * d, 1e-13);
  }
}

// D stands at x = 0: it reads δy - εz d; three runs of two visits: u/√6.
TEST(RunSeries, OfAProbeIsWhatItReads) {
  for (const char* id : {"D", "E"}) {
    const auto run = of_slopes(test::rig_x());
    const std::size_t k = id[0] == 'D' ? 3 : 4;
    const ProbeSeries series = probe_series(run, test::rig_x(), id, Axis::y).value();
    EXPECT_EQ(series.position_m, (Vec3{k == 3 ? 0.0 : 10e-3, 15e-3, 20e-3}));
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(series.set_up.error_m[i], run.points[i].point.probe_m[k], 1e-15) << id;
      EXPECT_NEAR(series.set_up.u_m[i], 10e-9 / std::sqrt(6.0), 1e-13) << id;
    }
  }
  auto run = of_slopes(test::rig_x());
  const double before = probe_series(run, test::rig_x(), "D", Axis::y)->set_up.error_m[2];
  run.header.sides.fixture_moves = true;
  EXPECT_NEAR(probe_series(run, test::rig_x(), "D", Axis::y)->set_up.error_m[2], -before, 1e-18);
}

TEST(RunSeries, RefusesAProbeThatLooksElsewhere) {
  const auto run = of_slopes(test::rig_x());
  const auto other = probe_series(run, test::rig_x(), "A", Axis::y);
  ASSERT_FALSE(other);
  EXPECT_NE(other.error().message.find("probe \"A\" does not look along Y"), std::string::npos);
  const auto none = probe_series(run, test::rig_x(), "Q", Axis::y);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("has no probe \"Q\" but A, B, C, D, E"), std::string::npos);
}

}  // namespace
}  // namespace mdof::algo
