// Tests readings outside the calibrated range of a probe.
#include "algo/plausibility/calibrated_stretch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/algo/rigs.h"
#include "tests/shown.h"

namespace mdof::algo {
namespace {

// Probe B is calibrated from t = -10 to 30 um (t: reading before the linearity correction). Its
// readings are 5 % too large.
Rig calibrated(bool gap = false) {
  Rig rig = test::rig_x();
  Calibration& c = rig.probes[1].calibration;
  c.calibrated_um = {-10, 30};
  c.linearity = {{-100, 5}, {100, -5}};
  c.reads_gap = gap;
  return rig;
}

MeasuredPoint point(double reading_m, bool valid = true) {
  MeasuredPoint p;
  p.point.probe_m = {90e-6, reading_m, 90e-6, 90e-6, 90e-6};
  p.errors.valid = valid;
  return p;
}

TEST(CalibratedStretch, ReportsReadingsOutsideTheRange) {
  const auto said =
      calibrated_range_notices(calibrated(), {point(-20e-6), point(40e-6), point(5e-6)});
  ASSERT_EQ(said.size(), 1U);
  EXPECT_EQ(said[0].severity, Severity::doubtful);
  // As displacements, the ends of the range are 0.95 times -10 and 30 um.
  EXPECT_EQ(test::shown(said),
            "beyond_calibration B from_um=-20 to_um=40 calibrated_from_um=-9.5 "
            "calibrated_to_um=28.5\n");
  // If the probe reads a gap, the reading increases when the target moves away.
  EXPECT_EQ(test::shown(calibrated_range_notices(calibrated(true), {point(0), point(40e-6)})),
            "beyond_calibration B from_um=0 to_um=40 calibrated_from_um=-28.5 "
            "calibrated_to_um=9.5\n");
}

TEST(CalibratedStretch, AcceptsATenthBeyondTheRange) {
  // A tenth of the range of 38 um is 3.8 um.
  EXPECT_TRUE(calibrated_range_notices(calibrated(), {point(-13.2e-6), point(32.2e-6)}).empty());
  EXPECT_EQ(calibrated_range_notices(calibrated(), {point(-13.4e-6)}).size(), 1U);
  EXPECT_EQ(calibrated_range_notices(calibrated(), {point(32.4e-6)}).size(), 1U);
}

TEST(CalibratedStretch, HasNoNoticeWithoutReadingsOrCalibration) {
  EXPECT_TRUE(calibrated_range_notices(test::rig_x(), {point(90e-6)}).empty());
  EXPECT_TRUE(calibrated_range_notices(calibrated(), {point(90e-6, false)}).empty());
  EXPECT_TRUE(calibrated_range_notices(calibrated(), {point(std::nan(""))}).empty());
  EXPECT_TRUE(calibrated_range_notices(calibrated(), std::vector<MeasuredPoint>()).empty());
}

}  // namespace
}  // namespace mdof::algo
