// The default values of requests equal the numbers in the manual and in the papers that the headers
// cite.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "algo/compensation/compensation.h"
#include "algo/compensation/table_limits.h"
#include "algo/compensation/volumetric/volumetric.h"
#include "algo/form/cutting.h"
#include "algo/form/registration.h"
#include "algo/form/spiral_path.h"
#include "algo/machine/geometric_tests/circle.h"
#include "algo/machine/geometric_tests/diagonal.h"
#include "algo/machine/plane_map.h"
#include "algo/on_the_fly/target_grid.h"
#include "algo/part/part_error.h"
#include "algo/points/align.h"
#include "algo/points/dwell.h"
#include "algo/sensitivity/adaptive.h"
#include "algo/sensitivity/plan/mounting.h"
#include "algo/sensitivity/simulation.h"
#include "algo/sensitivity/statistics/statistics.h"
#include "algo/separation/separate.h"
#include "algo/sequence/sequence.h"
#include "algo/uncertainty/budget/budget.h"

namespace mdof::algo {
namespace {

bool is_within_limits(bool angle, double at_m, double value) {
  return check_limits("EYX", angle, {0, at_m}, {0, value}, TableLimits{}).has_value();
}

// A table is accepted up to 1 mm and 50 µm/mm if its values are lengths, and up to 10 mrad and 0.5
// mrad/mm if they are angles.
TEST(DocumentedDefaults, ApplyToTableLimits) {
  EXPECT_TRUE(is_within_limits(false, 1, 0.99e-3));
  EXPECT_FALSE(is_within_limits(false, 1, 1.01e-3));
  EXPECT_TRUE(is_within_limits(false, 1e-3, 49e-6));
  EXPECT_FALSE(is_within_limits(false, 1e-3, 51e-6));
  EXPECT_TRUE(is_within_limits(true, 1, 9.9e-3));
  EXPECT_FALSE(is_within_limits(true, 1, 10.1e-3));
  EXPECT_TRUE(is_within_limits(true, 1e-3, 0.49e-3));
  EXPECT_FALSE(is_within_limits(true, 1e-3, 0.51e-3));
}

TEST(DocumentedDefaults, ApplyToTables) {
  EXPECT_TRUE(TableOptions{}.remove_slope);
  EXPECT_FALSE(TableOptions{}.take_partial);
  const VolumetricRequest request;
  EXPECT_EQ(request.step_m, 10e-3);
  EXPECT_FALSE(request.incomplete);
  EXPECT_EQ(SequenceOptions{}.target_window_m, 0.25e-3);
  EXPECT_EQ(SeparationRequest{}.match_m, 20e-6);
  EXPECT_FALSE(SeparationRequest{}.u_is_noise);
}

TEST(DocumentedDefaults, ApplyToPointsAndFrames) {
  const DwellOptions dwell;
  EXPECT_EQ(dwell.tolerance_m, 0);
  EXPECT_EQ(dwell.window_s, 0.05);
  EXPECT_EQ(dwell.settle_s, 0.1);
  EXPECT_EQ(dwell.leave_s, 0);
  EXPECT_EQ(dwell.min_length_s, 0.1);
  EXPECT_EQ(dwell.approach_m, 50e-6);
  EXPECT_EQ(dwell.max_speed_m_s, 100);
  EXPECT_EQ(AlignOptions{}.lag_bound_s, 3);
  EXPECT_EQ(AlignOptions{}.max_gap_s, 0.05);
  EXPECT_EQ(OnTheFlyOptions{}.interval_mm, 1);
  EXPECT_EQ(OnTheFlyOptions{}.bin_mm, 0);
}

TEST(DocumentedDefaults, ApplyToSurfaceForms) {
  const SpiralRequest spiral;
  EXPECT_EQ(spiral.x_centre_m, 0);
  EXPECT_EQ(spiral.y_centre_m, 0);
  EXPECT_EQ(spiral.outer_radius_m, 0);
  EXPECT_EQ(spiral.feed_m, 0);
  EXPECT_EQ(spiral.points_per_turn, 720u);
  EXPECT_EQ(spiral.tool_radius_m, 0);
  EXPECT_EQ(spiral.extend_pixels, 3u);
  EXPECT_FALSE(CuttingPasses{}.repeated);
  EXPECT_EQ(CuttingPasses{}.smooth_m, 0);
  EXPECT_EQ(MapPose{}.shift_x_m, 0);
  EXPECT_EQ(MapPose{}.shift_y_m, 0);
  EXPECT_EQ(MapPose{}.turn_rad, 0);
}

TEST(DocumentedDefaults, ApplyToMachines) {
  const CircleRequest circle;
  EXPECT_EQ(circle.first, 0u);
  EXPECT_EQ(circle.second, 1u);
  EXPECT_EQ(circle.radius_m, 0);
  EXPECT_EQ(circle.angles, 360u);
  const PlaneMapRequest map;
  EXPECT_EQ(map.first, 0u);
  EXPECT_EQ(map.second, 1u);
  EXPECT_EQ(map.step_m, 10e-3);
  EXPECT_FALSE(map.without_angles);
  EXPECT_FALSE(map.extremes_only);
  EXPECT_EQ(DiagonalLines{}.u_line_m, 0);
}

// Values from the appendix of the paper that simulation.h cites.
TEST(DocumentedDefaults, ApplyToSimulationOne) {
  const SimulationOptions o;
  EXPECT_EQ(o.angle_range_urad, 1000);
  EXPECT_EQ(o.offset_range_um, 50);
  EXPECT_EQ(o.travel_from_mm, 0);
  EXPECT_EQ(o.travel_to_mm, 60);
  EXPECT_EQ(o.travel_bins, 20u);
  EXPECT_EQ(o.l_mm, 10);
  EXPECT_EQ(o.side_plane_mm, 0);
  EXPECT_EQ(o.side_height_mm, 20);
  for (const double none : {o.radius_um, o.theta_y_mrad, o.theta_p_mrad, o.theta_r_mrad,
                            o.sigma_x_um, o.sigma_y_um, o.sigma_z_um})
    EXPECT_EQ(none, 0);
  EXPECT_EQ(o.seed, 1u);
}

TEST(DocumentedDefaults, ApplyToTrials) {
  EXPECT_EQ(TrialsRequest{}.trials, 0u);
  EXPECT_EQ(TrialsRequest{}.seed, 1u);
  EXPECT_EQ(SummaryRequest{}.coverage, 0.95);
  EXPECT_EQ(AdaptiveTolerance{}.digits, 2);
  EXPECT_EQ(PartTrials{}.shares, 2000u);
  EXPECT_EQ(PartTrials{}.errors, 400u);
}

// A mounting without deviations is the nominal fixture.
TEST(DocumentedDefaults, ApplyToMountings) {
  const ProbeDeviation probe;
  for (const double none : {probe.circle_m, probe.circle_turns, probe.tilt_rad, probe.tilt_turns,
                            probe.zero_m, probe.drift_m})
    EXPECT_EQ(none, 0);
  EXPECT_EQ(probe.gain, 1);
  EXPECT_EQ(PlaneDeviation{}.map_scale, 1);
  EXPECT_EQ(PlaneDeviation{}.flatness_m, 0);
  EXPECT_EQ(Mounting{}.fixture_expansion, 0);
  EXPECT_EQ(Mounting{}.target_expansion, 0);
}

}  // namespace
}  // namespace mdof::algo
