#include "algo/calibration/sensitivity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include "algo/uncertainty/coverage.h"
#include "schema/rig/effects/physics.h"
#include "schema/units.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

// Probe A (index 0) of test::rig_x(); the traverse is along Z, in which A measures.
constexpr std::size_t kA = 0;

template <class Reads>
Traverse along_z(Reads reads, int n = 11, double reach_m = 80e-6) {
  Traverse traverse{Axis::z, {}};
  for (int i = 0; i < n; ++i) {
    const double z = reach_m * (2.0 * i / (n - 1) - 1);
    TraverseStop stop{0.2 + z, std::vector<double>(5, std::nan("")), std::vector<double>(5, 1e-9)};
    stop.reading_m[kA] = reads(z);
    traverse.stops.push_back(stop);
  }
  return traverse;
}

TEST(Sensitivity, MatchesSlopeAndUncertaintyByHand) {
  // The readings alternate by ±20 nm about a straight line. The standard deviation of the slope
  // over 11 points is calculated by hand.
  int k = 0;
  const auto found = fit_sensitivity(test::rig_x(), kA, along_z([&](double z) {
                                       return 3e-6 + 1.002 * z + (k++ % 2 ? 20e-9 : -20e-9);
                                     }));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->sensitivity_1, 1.002, 1e-12);
  const double mean = -20e-9 / 11, sum = 11 * 400e-18 - 11 * mean * mean;
  double squares = 0;
  for (int i = 0; i < 11; ++i) squares += std::pow(80e-6 * (2.0 * i / 10 - 1), 2);
  EXPECT_NEAR(found->u_sensitivity_1, std::sqrt(sum / 9 / squares), 1e-9);
  EXPECT_EQ(found->freedom, 9);
  EXPECT_NEAR(found->linearity_m, 20e-9 - mean, 1e-12);
  EXPECT_EQ(found->stops, 11U);
  EXPECT_FALSE(found->um_per_V);
}

// The correction divides the readings by the sensitivity. So the relative u of the corrected
// readings does not depend on the scale of the readings before the correction.
TEST(Sensitivity, RelativeUDoesNotDependOnTheScaleOfTheReadings) {
  const auto with_scale = [](double scale) {
    int k = 0;
    return *fit_sensitivity(test::rig_x(), kA, along_z([&](double z) {
                              return scale * (z + (k++ % 2 ? 20e-9 : -20e-9));
                            }));
  };
  const auto half = with_scale(0.6), whole = with_scale(1);
  EXPECT_NEAR(half.u_sensitivity_1, 0.6 * whole.u_sensitivity_1, 1e-12);
  EXPECT_NEAR(half.relative_u(), whole.relative_u(), 1e-9 * whole.relative_u());
  EXPECT_NEAR(whole.relative_u(), whole.u_sensitivity_1, 1e-3 * whole.u_sensitivity_1);
}

// Share (%) of 5,000 intervals that contain the true sensitivity; the coverage factor follows from
// the degrees of freedom. The axis visits `places` positions in both directions. The readings have
// white noise, and an encoder error that is the same at both visits of a position.
double coverage_percent(const std::string& of_rig, double encoder_m, double noise_m, int places) {
  const Rig rig = test::rig_x_with("", "", of_rig);
  std::mt19937_64 engine(5);
  std::normal_distribution<> normal;
  constexpr int kTrials = 5000;
  int held = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Traverse traverse = along_z([&](double z) { return z; }, places);
    for (TraverseStop& stop : traverse.stops) stop.travel_m += encoder_m * normal(engine);
    const auto there = traverse.stops;
    traverse.stops.insert(traverse.stops.end(), there.rbegin(), there.rend());
    for (TraverseStop& stop : traverse.stops) {
      stop.reading_m[kA] += noise_m * normal(engine);
      stop.u_reading_m[kA] = noise_m;
    }
    const auto found = fit_sensitivity(rig, kA, traverse).value();
    held +=
        std::abs(found.sensitivity_1 - 1) <= coverage_factor(found.freedom) * found.u_sensitivity_1;
  }
  return 100.0 * held / kTrials;
}

TEST(Sensitivity, IntervalsCoverAnEncoderErrorAtEachPosition) {
  const std::string declared = "[encoder]\nu_um = 0.2\n";
  // 95 % minus three standard deviations of the share for 5,000 trials.
  for (const int places : {5, 11}) {
    SCOPED_TRACE(places);
    EXPECT_GT(coverage_percent(declared, 0.2e-6, 10e-9, places), 94);
    // The rig does not declare the encoder error, but the residuals contain it.
    EXPECT_GT(coverage_percent("", 0.2e-6, 10e-9, places), 94);
    EXPECT_GT(coverage_percent("", 0, 50e-9, places), 94);
  }
}

TEST(Sensitivity, ReportsContributionsThatUDoesNotContain) {
  const auto says = [](const Rig& rig) {
    const auto found = fit_sensitivity(rig, kA, along_z([](double z) { return z; })).value();
    std::string all;
    for (const auto& what : found.not_seen) all += what + "\n";
    return all;
  };
  const std::string bare = says(test::rig_x());
  for (const char* what : {"scale error of the encoder", "squareness", "[encoder] u_um"})
    EXPECT_NE(bare.find(what), std::string::npos) << what;
  EXPECT_EQ(says(test::rig_x_with("", "", "[encoder]\nu_um = 0.1\n")).find("u_um"),
            std::string::npos);
}

// The proposed table corrects the readings, for a probe that reads displacements and for one that
// reads gaps.
TEST(Sensitivity, ProposedTableCorrectsTheReadings) {
  const auto curve = [](double z) { return 2e-6 + 1.003 * z + 40 * z * z; };
  for (const char* reads : {"displacement", "gap"})
    for (const char* volts : {"", "um_per_V = 10\n"}) {
      const Rig rig =
          test::rig_x_with("A", std::string("reads = \"") + reads +
                                    "\"\noffset_um = 100\nvalid_um = [-100, 300]\n" + volts);
      const auto found = fit_sensitivity(rig, kA, along_z(curve));
      ASSERT_TRUE(found) << found.error().message;
      EXPECT_EQ(found->um_per_V.has_value(), volts[0] != '\0');
      const double sign = std::string(reads) == "gap" ? -1 : 1;
      double zero_um = std::nan("");
      std::size_t k = 0;
      for (const auto& [t_um, correction_um] : found->linearity) {
        if (t_um < found->calibrated_um[0] || t_um > found->calibrated_um[1]) continue;
        // The test calculates the raw number from the reading and applies the proposed rig to it.
        const double displacement_um = sign * (t_um + correction_um);
        const auto i = sign > 0 ? k : 10 - k;
        const double z = 80e-6 * (2.0 * static_cast<double>(i) / 10 - 1);
        const double raw_um = 100 + sign * to_um(curve(z));
        const double new_raw_um = found->um_per_V ? raw_um / 10 * *found->um_per_V : raw_um;
        EXPECT_NEAR(new_raw_um - (found->um_per_V ? found->offset_um : 100), t_um, 1e-9);
        if (k == 0) zero_um = displacement_um - to_um(z);
        EXPECT_NEAR(displacement_um - to_um(z), zero_um, 1e-9);
        ++k;
      }
      EXPECT_EQ(k, 11U);
    }
}

// Stops at one position are one point of the table, also if backlash separates their readings.
// Otherwise the table is a saw-tooth: 0.5 um of travel without a change of the corrected reading.
TEST(Sensitivity, TableContainsTheMeanOfBothApproaches) {
  const Rig rig = test::rig_x_with("A", "um_per_V = 10\n");
  Traverse both = along_z([](double z) { return 1.01 * z; });
  for (const TraverseStop& stop : along_z([](double z) { return 1.01 * z - 0.5e-6; }).stops)
    both.stops.push_back(stop);
  const auto found = fit_sensitivity(rig, kA, both);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->sensitivity_1, 1.01, 1e-9);
  EXPECT_EQ(found->linearity.size(), 11U);
  for (const auto& [reading_um, correction_um] : found->linearity)
    EXPECT_NEAR(correction_um, 0, 1e-9) << reading_um;
  EXPECT_NE(found->not_seen.back().find("up to 0.5 um between stops at the same position"),
            std::string::npos)
      << found->not_seen.back();
}

// The traverse covers ±12 um. The table continues with the same slope over the whole range: raw =
// 100 ± (5 + 1.02 z).
TEST(Sensitivity, TableWithoutScaleCoversTheRange) {
  for (const double sign : {1.0, -1.0}) {
    const Rig rig = test::rig_x_with("A", std::string("reads = ") +
                                              (sign > 0 ? "\"displacement\"" : "\"gap\"") +
                                              "\noffset_um = 100\nvalid_um = [-40, 250]\n");
    const auto found =
        fit_sensitivity(rig, kA, along_z([](double z) { return 5e-6 + 1.02 * z; }, 7, 12e-6));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_NEAR(found->calibrated_um[0], sign * 5 - 1.02 * 12, 1e-9);
    EXPECT_NEAR(found->calibrated_um[1], sign * 5 + 1.02 * 12, 1e-9);
    Calibration as_proposed;
    as_proposed.linearity = found->linearity;
    for (const double raw_um : {-40.0, 10.0, 100.0, 103.0, 180.0, 250.0}) {
      const double t_um = raw_um - 100;  // 1.02 times the displacement from raw = 100
      EXPECT_NEAR(t_um + linearity_um(as_proposed, t_um), t_um / 1.02, 1e-9) << raw_um;
    }
    EXPECT_NEAR(found->linearity.front()[0], -140, 1e-12);
    EXPECT_NEAR(found->linearity.back()[0], 150, 1e-12);
  }
}

TEST(Sensitivity, RefusesImplausibleTraverses) {
  const Rig rig = test::rig_x();
  const auto says = [&](const Traverse& traverse, const char* what) {
    const auto found = fit_sensitivity(rig, kA, traverse);
    ASSERT_FALSE(found);
    EXPECT_EQ(found.error().code, ErrorCode::check);
    EXPECT_NE(found.error().message.find(what), std::string::npos) << found.error().message;
  };
  says(along_z([](double z) { return z; }, 2), "at 2 positions");
  says(along_z([](double z) { return z; }, 11, 1e-6), "cover the part of the range that you use");
  says(along_z([](double z) { return -z; }), "check the keys \"reads\" and \"measures\"");
  says(along_z([](double z) { return 2.5 * z; }), "um_per_V");
  says(along_z([](double) { return std::nan(""); }), "at 0 positions over 0 um");
  says(along_z([](double z) { return std::abs(z) < 1e-6 ? z : std::nan(""); }),
       "10 of 11 stops have no usable reading, because the readings are outside the range");
  says(along_z([](double z) { return std::min(z, 50e-6); }),
       "changes by 2 um in a step of 16 um, from the reading 48 um");
  EXPECT_EQ(approaching_axis(rig, kA).value(), Axis::z);
  EXPECT_EQ(approaching_axis(rig, 3).value(), Axis::y);
}

// A probe with the slope 1 needs no correction, for any zeros of the probe and of the axis.
TEST(Sensitivity, ExactProbeGetsNoCorrection) {
  int k = 0;
  const auto found = fit_sensitivity(
      test::rig_x(), kA, along_z([&](double z) { return 3e-6 + z + (k++ % 2 ? 1e-15 : 0); }));
  ASSERT_TRUE(found) << found.error().message;
  ASSERT_EQ(found->linearity.size(), 13u);  // at 11 positions and at both ends of the range
  for (std::size_t i = 0; i < 13; ++i) {
    const double at_um = i == 0 ? -100 : i == 12 ? 100 : 3 - 80 + 16.0 * static_cast<double>(i - 1);
    EXPECT_NEAR(found->linearity[i][0], at_um, 1e-6);
    EXPECT_NEAR(found->linearity[i][1], 0, 1e-6);
  }
  EXPECT_NEAR(found->from_m, -77e-6, 1e-12);
  EXPECT_NEAR(found->to_m, 83e-6, 1e-12);
}

// The noise of each visit and the encoder error of each position are weighted by the coefficients
// of the slope.
TEST(Sensitivity, UncertaintyCombinesVisitsAndPositions) {
  const Rig rig = test::rig_x_with("", "", "[encoder]\nu_um = 0.3\n");
  Traverse traverse = along_z([](double z) { return 1.01 * z; }, 5);
  traverse.stops.push_back(traverse.stops[1]);
  traverse.stops.push_back(traverse.stops[4]);
  for (std::size_t i = 0; i < traverse.stops.size(); ++i)
    traverse.stops[i].u_reading_m[kA] = 1e-7 * static_cast<double>(1 + i);
  double mean = 0, square = 0;
  for (const TraverseStop& stop : traverse.stops) mean += stop.travel_m / 7;
  for (const TraverseStop& stop : traverse.stops) square += std::pow(stop.travel_m - mean, 2);
  double variance = 0;
  std::map<double, double> lever;
  for (const TraverseStop& stop : traverse.stops) {
    const double by = (stop.travel_m - mean) / square;
    variance += std::pow(by * stop.u_reading_m[kA], 2);
    lever[stop.travel_m] += by;
  }
  for (const auto& [place, by] : lever) variance += std::pow(by * 1.01 * 0.3e-6, 2);
  const auto found = fit_sensitivity(rig, kA, traverse);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_NEAR(found->u_sensitivity_1, std::sqrt(variance), 1e-12);
  EXPECT_TRUE(std::isinf(found->freedom));
  EXPECT_NEAR(found->residual_sd_m, 0, 1e-12);
  EXPECT_EQ(found->id, "A");
}

TEST(Sensitivity, StatesTheResidualStandardDeviation) {
  int k = 0;
  const auto found = fit_sensitivity(
      test::rig_x(), kA, along_z([&](double z) { return z + (k++ % 2 ? 20e-9 : -20e-9); }));
  // The readings alternate about their mean of -20/11 nm. There are nine degrees of freedom.
  const double mean = -20e-9 / 11;
  EXPECT_NEAR(found->residual_sd_m, std::sqrt((11 * 400e-18 - 11 * mean * mean) / 9), 1e-15);
}

// Sensitivities from 0.5 to 2 are accepted.
TEST(Sensitivity, AcceptsSensitivitiesFromHalfToTwo) {
  const auto is_taken = [](double by) {
    return fit_sensitivity(test::rig_x(), kA, along_z([&](double z) { return by * z; }))
        .has_value();
  };
  EXPECT_TRUE(is_taken(0.505));
  EXPECT_FALSE(is_taken(0.495));
  EXPECT_TRUE(is_taken(1.98));
  EXPECT_FALSE(is_taken(2.02));
}

// The probe is inclined by a cosine of 0.8 to the normal of the plane, along which the axis moves:
// a travel z causes the displacement z/0.8 along the probe.
TEST(Sensitivity, RefersToTheDisplacementAlongAnObliqueProbe) {
  Rig rig = test::rig_x();
  rig.probes[kA].direction = {0, 0.6, 0.8};
  rig.probes[kA].nominal_direction = Vec3{0, 0, 1};
  const auto found =
      fit_sensitivity(rig, kA, along_z([](double z) { return 1.01 * z / 0.8; })).value();
  EXPECT_NEAR(found.sensitivity_1, 1.01, 1e-12);
  EXPECT_NEAR(found.linearity_m, 0, 1e-15);
  EXPECT_EQ(approaching_axis(rig, kA).value(), Axis::z);
}

}  // namespace
}  // namespace mdof::algo
