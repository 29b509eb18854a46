// Tests notices about wrong units on both sides of each limit. Mutation tests (tests/mutate) found
// these cases.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "algo/plausibility/plausibility.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

constexpr double kRange_m = 400e-6;

// A rig without faults. It has five probes 5 mm apart. Probe B reads a gap.
Rig rig_with_gap_probe() {
  Rig rig;
  for (int k = 0; k < 5; ++k) {
    Probe probe;
    probe.id = std::string(1, static_cast<char>('A' + k));
    probe.position_m = {5e-3 * k, 0, 0};
    probe.range_m = kRange_m;
    rig.probes.push_back(probe);
  }
  rig.probes[1].calibration.reads_gap = true;
  return rig;
}

Plausibility figures() {
  Plausibility p;
  p.rate_hz = 1000;
  p.encoder_max_m = 60e-3;
  for (const char* id : {"A", "B", "C", "D", "E"})
    p.probes.push_back({id, 78, 10e-9, 20e-6, -8e-6, 12e-6});
  return p;
}

std::size_t said_of(const Plausibility& p, const Rig& rig = rig_with_gap_probe()) {
  return unit_notices(rig, p).size();
}

std::size_t count_probe_notices(const ProbeFigures& probe) {
  Plausibility p = figures();
  p.probes[1] = probe;
  return said_of(p);
}

TEST(UnitsLimits, ReportsTravelBeyondEachLimit) {
  for (const auto& [travel_m, said] :
       {std::pair(0.49e-3, 1u), std::pair(0.5e-3, 0u), std::pair(2.0, 0u), std::pair(2.01, 1u)}) {
    EXPECT_EQ(encoder_unit_notice(travel_m).has_value(), said != 0) << travel_m;
    Plausibility p = figures();
    p.encoder_min_m = -0.25 * travel_m, p.encoder_max_m = 0.75 * travel_m;
    EXPECT_EQ(said_of(p), said) << travel_m;
  }
}

TEST(UnitsLimits, ReportsRateBeyondEachLimit) {
  for (const auto& [rate_hz, said] : {std::pair(1.9, 1u), std::pair(2.0, 0u), std::pair(2e6, 0u),
                                      std::pair(2.1e6, 1u), std::pair(kNaN, 0u)}) {
    Plausibility p = figures();
    p.rate_hz = rate_hz;
    EXPECT_EQ(said_of(p), said) << rate_hz;
  }
}

// A probe is reported if its readings are within a thousandth of half its range, 0.2 um, and its
// noise is below 0.5 nm.
TEST(UnitsLimits, ReportsAProbeInMillimetres) {
  const double least_m = 1e-3 * kRange_m / 2;
  EXPECT_EQ(count_probe_notices({"B", 78, 0.1e-9, 1e-9, -least_m, 0}), 1u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0.1e-9, 1e-9, 0, least_m}), 1u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0.1e-9, 1e-9, 0, 1.01 * least_m}), 0u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0.1e-9, 1e-9, -1.01 * least_m, 0}), 0u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0.5e-9, 1e-9, 0, least_m}), 0u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0.49e-9, 1e-9, 0, least_m}), 1u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0, 0, 0, least_m}),
            0u);                                                // the reading does not change
  EXPECT_EQ(count_probe_notices({"B", 0, 0, 1e-9, 0, 0}), 0u);  // no readings
}

// A probe is reported if its noise exceeds both 1 um and 0.25 % of its range.
TEST(UnitsLimits, ReportsAProbeInNanometres) {
  EXPECT_EQ(count_probe_notices({"B", 78, 1.01e-6, 20e-6, -8e-6, 12e-6}), 1u);
  EXPECT_EQ(count_probe_notices({"B", 78, 0.99e-6, 20e-6, -8e-6, 12e-6}), 0u);
  Rig wide = rig_with_gap_probe();
  wide.probes[1].range_m = 4e-3;
  for (const double sd_m : {9.9e-6, 10.1e-6}) {
    Plausibility p = figures();
    p.probes[1].sd_m = sd_m;
    EXPECT_EQ(said_of(p, wide), sd_m > 10e-6 ? 1u : 0u) << sd_m;
  }
}

// A probe is reported if the middle of its readings differs from zero by more than a tenth of its
// range, 40 um.
TEST(UnitsLimits, ReportsAGapWithoutOffset) {
  EXPECT_EQ(count_probe_notices({"B", 78, 10e-9, 20e-6, -50.1e-6, -30e-6}), 1u);
  EXPECT_EQ(count_probe_notices({"B", 78, 10e-9, 20e-6, -49.9e-6, -30e-6}), 0u);
  const double tenth_m = 0.1 * kRange_m;
  EXPECT_EQ(count_probe_notices({"B", 78, 10e-9, 0, -tenth_m, -tenth_m}), 0u);
  EXPECT_EQ(count_probe_notices({"B", 78, 10e-9, 300e-6, -300e-6, 0}),
            0u);  // the readings include 0
  EXPECT_EQ(count_probe_notices({"B", 78, 10e-9, 20e-6, 80e-6, 100e-6}), 0u);
  EXPECT_EQ(count_probe_notices({"B", 0, 10e-9, 20e-6, -100e-6, -80e-6}), 0u);
}

TEST(UnitsLimits, ReportsFixtureSizeBeyondEachLimit) {
  for (const auto& [size_m, said] :
       {std::pair(0.49e-3, 1u), std::pair(0.51e-3, 1u), std::pair(4.9e-3, 1u),
        std::pair(5.1e-3, 0u), std::pair(0.299, 0u), std::pair(0.301, 1u), std::pair(0.51, 1u)}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      Rig rig = rig_with_gap_probe();
      for (std::size_t k = 0; k < 5; ++k) {
        rig.probes[k].position_m = {};
        rig.probes[k].position_m[axis] = size_m * static_cast<double>(k) / 4;
      }
      EXPECT_EQ(said_of(figures(), rig), said) << size_m << " along " << axis;
      // The fixture is far from the origin.
      for (auto& probe : rig.probes) probe.position_m[axis] -= 0.6;
      EXPECT_EQ(said_of(figures(), rig), size_m < 5e-3 ? 2u : 1u) << size_m;
    }
  }
}

// A default fixture of 35 mm. Its positions are written in cm, in mm, and in tenths of a mm.
TEST(UnitsLimits, ReportsLengthsWrongByAFactorOfTen) {
  for (const auto& [factor, says] : {std::pair(0.1, "fixture_too_narrow"), std::pair(1.0, ""),
                                     std::pair(10.0, "fixture_too_wide")}) {
    Rig rig = test::rig_x();
    for (auto& probe : rig.probes)
      for (double& x : probe.position_m) x *= factor;
    Plausibility p = figures();
    p.encoder_max_m = 40e-3;
    const auto said = unit_notices(rig, p);
    ASSERT_EQ(said.size(), *says == '\0' ? 0u : 1u) << factor;
    if (said.empty()) continue;
    EXPECT_STREQ(to_string(said[0].code), says);
  }
}

}  // namespace
}  // namespace mdof::algo
