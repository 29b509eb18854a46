// Each result is 0 or "not found" if there are no readings, one reading or constant readings.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "algo/compensation/thinning.h"
#include "algo/drift/run_drift.h"
#include "algo/drift/series_drift.h"
#include "algo/form/clamping.h"
#include "algo/form/map_figures.h"
#include "algo/form/spiral_path.h"
#include "algo/form/turn_spectrum.h"
#include "algo/iso230/line_fit.h"
#include "algo/machine/geometric_tests/perpendicularity.h"
#include "algo/on_the_fly/bin_fit.h"
#include "algo/on_the_fly/reading_lag.h"
#include "algo/plausibility/noise_floor.h"
#include "algo/plausibility/resolution.h"
#include "algo/points/robust_mean.h"
#include "algo/sensitivity/adaptive.h"

namespace mdof::algo {
namespace {

SurfaceMap even_map(std::size_t n, double z_m) {
  return {"map", 0, 0, 1e-3, 1e-3, n, n, std::vector<double>(n * n, z_m), {}};
}

TEST(ResultsOfNothing, MapWithoutHeightsGivesZeros) {
  const SurfaceMap empty = even_map(4, SurfaceMap::kMissing);
  const MapFigures figures = figures_of(empty);
  EXPECT_EQ(figures.pv_m, 0);
  EXPECT_EQ(figures.rms_m, 0);
  EXPECT_EQ(figures.mean_m, 0);
  EXPECT_EQ(figures.pixels, 0u);
  const Plane plane = plane_of(empty);
  for (const double none :
       {plane.x_mean_m, plane.y_mean_m, plane.piston_m, plane.tilt_x, plane.tilt_y})
    EXPECT_EQ(none, 0);
  const FarthestPixel farthest = farthest_pixel(empty, 1, 2);
  EXPECT_EQ(farthest.radius_m, 0);
  EXPECT_EQ(farthest.x_m, 0);
  EXPECT_EQ(farthest.y_m, 0);
}

TEST(ResultsOfNothing, MapWithOneHeightGivesItsHeight) {
  SurfaceMap one = even_map(4, SurfaceMap::kMissing);
  one.z_m[6] = 5e-6;
  const Plane plane = plane_of(one);
  EXPECT_EQ(plane.piston_m, 5e-6);
  EXPECT_EQ(plane.tilt_x, 0);
  EXPECT_EQ(plane.tilt_y, 0);
  EXPECT_EQ(plane.at(7, 8), 5e-6);
  EXPECT_EQ(figures_of(one).rms_m, 0);
}

TEST(ResultsOfNothing, FlatPlateHasNoStress) {
  const auto stress = plate_stress(even_map(9, 0), {1e-3, 70e9, 0.3}, 4e-3);
  ASSERT_TRUE(stress);
  EXPECT_EQ(stress->max_Pa, 0);
  EXPECT_EQ(stress->x_m, 0);
  EXPECT_EQ(stress->y_m, 0);
}

TEST(ResultsOfNothing, PathWithoutLowPassOmitsNothing) {
  TurnSpectrum path(8, -1);
  for (int k = 0; k < 16; ++k) path.add(1e-15 * std::cos(k * std::numbers::pi / 4));
  path.finish();
  EXPECT_EQ(path.turns(), 2u);
  EXPECT_EQ(path.left_out().pv, 0);
  EXPECT_EQ(path.left_out().rms, 0);
  EXPECT_EQ(path.undulations(0.5), 1u);  // one undulation, however small its amplitude is
}

TEST(ResultsOfNothing, TwoPointsLeaveNoResidual) {
  const std::vector<double> x = {1, 3}, y = {2, 8};
  for (const Line& line : {least_squares_line(x, y), end_point_line(x, y)}) {
    EXPECT_NEAR(line.slope, 3, 1e-15);
    EXPECT_NEAR(line.intercept, -1, 1e-14);
    EXPECT_EQ(line.residual_sd, 0);
    EXPECT_EQ(line.u_slope, 0);
    EXPECT_EQ(line.u_intercept, 0);
  }
  EXPECT_EQ(Line{}.at(5), 0);
}

TEST(ResultsOfNothing, FewReadingsGiveNoScatter) {
  std::vector<double> scratch;
  const RobustMean none = robust_mean({}, 1e-9, scratch);
  for (const double figure : {none.mean, none.sd, none.u}) EXPECT_EQ(figure, 0);
  EXPECT_EQ(none.used + none.rejected, 0u);
  const std::vector<double> five = {5};
  const RobustMean one = robust_mean(five, 1e-9, scratch);
  EXPECT_EQ(one.mean, 5);
  EXPECT_EQ(one.sd, 0);
  EXPECT_EQ(one.u, 0);
  EXPECT_EQ(one.used, 1u);
  EXPECT_EQ(one.rejected, 0u);
  const std::vector<double> seven(7, 2.0), place = {-0.9, -0.6, -0.3, 0, 0.3, 0.6, 0.9};
  const BinFit bin = fit_bin(place, seven, 1e-9, scratch);
  for (const double figure : {bin.value, bin.slope, bin.sd, bin.u}) EXPECT_EQ(figure, 0);
  EXPECT_EQ(bin.used, 7u);
  EXPECT_EQ(bin.rejected, 0u);
  EXPECT_EQ(NoiseFloor().sd(), 0);
  EXPECT_EQ(Resolution().step(), 0);
}

// With tolerance 0 all points remain.
TEST(ResultsOfNothing, ZeroToleranceKeepsAllPoints) {
  const auto all = thinned({0, 1, 2}, {{0, 5, 1}}, 0);
  ASSERT_TRUE(all);
  EXPECT_EQ(all->kept.size(), 3u);
  EXPECT_EQ(all->largest_deviation, 0);
}

// The axis visits each place once. Such visits do not distinguish a drift from the form of the
// axis.
TEST(ResultsOfNothing, SingleVisitsShowNoDrift) {
  const DriftOfRun none({});
  EXPECT_EQ(none.found().length_s, 0);
  EXPECT_EQ(none.freedom(), 0);
  std::vector<TimedVisit> visits(8);
  for (std::size_t i = 0; i < visits.size(); ++i) {
    visits[i].place = i;
    visits[i].time_s = 10.0 * static_cast<double>(i);
  }
  const DriftFit fit(DriftDesign(visits), Eigen::MatrixXd::Random(8, 2), Eigen::VectorXd::Zero(2));
  EXPECT_EQ(fit.design().orders(), 0);
  EXPECT_EQ(fit.freedom(), 0);
  ASSERT_EQ(fit.series().size(), 2u);
  for (const SeriesDrift& series : fit.series()) {
    EXPECT_FALSE(series.significant());
    EXPECT_EQ(series.order, 0);
    for (const double figure : {series.change, series.u_change, series.range, series.least_found})
      EXPECT_EQ(figure, 0);
    EXPECT_FALSE(series.steps);
  }
  EXPECT_EQ(slow_noises({0, 10, 20}).front().share, 0);  // the first is white noise
}

TEST(ResultsOfNothing, NoPassesShowNoLag) {
  const auto lags = reading_lags({}, 1);
  ASSERT_EQ(lags.size(), 1u);
  EXPECT_TRUE(std::isnan(lags[0].delay_s));
  EXPECT_EQ(lags[0].largest_slope_1, 0);
  EXPECT_EQ(lags[0].effect_m, 0);
  EXPECT_FALSE(lags[0].significant);
}

TEST(ResultsOfNothing, AdaptiveRuleWithoutBlocksIsNotSettled) {
  const auto rule = AdaptiveRule::create({"EYX_um"}, {});
  ASSERT_TRUE(rule);
  EXPECT_EQ(rule->blocks(), 0u);
  EXPECT_EQ(rule->progress()[0].tolerance, 0);
  EXPECT_FALSE(rule->progress()[0].constant);
  EXPECT_FALSE(rule->settled());
  EXPECT_FALSE(rule->unsettled_output());
}

// A single turn cannot show a drift. A radius of 0 has no angle.
TEST(ResultsOfNothing, OneTurnShowsNoDrift) {
  CircleReadings readings;
  for (int k = 0; k < 36; ++k) {
    readings.angle_rad.push_back(k * std::numbers::pi / 18);
    readings.height_m.push_back(1e-7 * (k % 2));
  }
  EXPECT_FALSE(perpendicularity(readings, 1));
  readings.radius_m = 0.1;
  const auto found = perpendicularity(readings, 1);
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->drift_fitted);
  EXPECT_EQ(found->drift_m, 0);
  EXPECT_EQ(found->u_drift_m, 0);
}

}  // namespace
}  // namespace mdof::algo
