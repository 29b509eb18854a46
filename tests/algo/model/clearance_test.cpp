#include "algo/model/clearance.h"

#include <gtest/gtest.h>

namespace mdof::algo {
namespace {

// A probe of the default fixture of X: A, B, C at the top measure along Z, D, E at the side measure
// along Y.
std::string probe(const std::string& id, const std::string& position, const std::string& measures,
                  const std::string& more = "") {
  return "[[probe]]\nid = \"" + id + "\"\nposition_mm = " + position + "\n" + measures +
         "\nrange_um = 200\n" + more;
}

Rig rig_of(const std::string& side, const std::string& axis = "X", const std::string& more = "") {
  const std::string text = "name = \"r\"\naxis = \"" + axis + "\"\n" +
                           probe("A", "[10, 0, 0]", "measures = \"+Z\"") +
                           probe("B", "[0, 10, 0]", "measures = \"+Z\"") +
                           probe("C", "[0, -10, 0]", "measures = \"+Z\"") +
                           probe("D", "[0, 15, 20]", "measures = \"" + side + "\"", more) +
                           probe("E", "[10, 15, 20]", "measures = \"" + side + "\"", more);
  return parse_rig(text, "rig.toml").value();
}

std::string ids(const MotionClearance& motion) {
  std::string all;
  for (const auto& probe : motion.probes) all += probe.id;
  return all;
}

TEST(Clearance, SideProbesLimitYAndTopProbesLimitZ) {
  const auto motions = motion_clearances(rig_of("+Y")).value();
  EXPECT_EQ(ids(motions[0]), "");
  EXPECT_EQ(ids(motions[1]), "DE");
  EXPECT_EQ(ids(motions[2]), "ABC");
  for (const auto& probe : motions[1].probes) {
    EXPECT_NEAR(probe.range_m, 100e-6, 1e-12);
    EXPECT_EQ(probe.towards, 0);  // unknown if a probe reads displacements
    EXPECT_FALSE(probe.contact_m);
  }
  const std::string y = clearance_text(motions[1]);
  EXPECT_EQ(y.substr(0, 7), "HAZARD:");
  EXPECT_NE(y.find("D, E (D in both directions, E in both directions): the measuring range ends "
                   "after 100 um"),
            std::string::npos)
      << y;
  EXPECT_EQ(clearance_text(motions[0]).find("HAZARD"), std::string::npos);
}

TEST(Clearance, GapAndStandoffShowDirectionAndContact) {
  auto motions =
      motion_clearances(rig_of("-Y", "X", "sensing_radius_mm = 2\nstandoff_um = 250\n")).value();
  ASSERT_EQ(ids(motions[1]), "DE");
  EXPECT_EQ(motions[1].probes[0].towards, -1);
  EXPECT_NEAR(motions[1].probes[0].contact_m.value(), 250e-6, 1e-12);
  EXPECT_NE(clearance_text(motions[1]).find("D along -Y"), std::string::npos);
  EXPECT_NE(clearance_text(motions[1]).find("contact with D after 250 um"), std::string::npos);
  motions = motion_clearances(rig_of("+Y", "X", "reads = \"gap\"\noffset_um = 100\n")).value();
  EXPECT_EQ(motions[1].probes[0].towards, 1);
  EXPECT_NEAR(motions[1].probes[0].contact_m.value(), 100e-6, 1e-12);
}

// The surface is at a reading of 20, 30 or 150 um when the target is at its nominal position.
TEST(Clearance, RangeEndsAtTheNearerLimitOfTheReadings) {
  const auto range_um = [](const std::string& keys) {
    return motion_clearances(rig_of("+Y", "X", keys)).value()[1].probes[0].range_m * 1e6;
  };
  EXPECT_NEAR(range_um("offset_um = 20\n"), 80, 1e-6);
  EXPECT_NEAR(range_um("offset_um = -20\n"), 80, 1e-6);
  EXPECT_NEAR(range_um("reads = \"gap\"\noffset_um = 30\n"), 30, 1e-6);
  EXPECT_NEAR(range_um("reads = \"gap\"\noffset_um = 150\nvalid_um = [140, 160]\n"), 10, 1e-6);
}

TEST(Clearance, StandoffAloneShowsTheContact) {
  const auto motions = motion_clearances(rig_of("+Y", "X", "standoff_um = 250\n")).value();
  EXPECT_NEAR(motions[1].probes[0].contact_m.value(), 250e-6, 1e-12);
  EXPECT_EQ(motions[1].probes[0].towards, 1);
}

// The code transforms a rig for Y into its local frame and the result back to machine axes.
TEST(Clearance, RefersToTheMachineAxesForAnyAxis) {
  std::string text = "name = \"r\"\naxis = \"Y\"\n";
  text += probe("A", "[0, 10, 0]", "measures = \"+Z\"") +
          probe("B", "[-10, 0, 0]", "measures = \"+Z\"") +
          probe("C", "[10, 0, 0]", "measures = \"+Z\"") +
          probe("D", "[-15, 0, 20]", "measures = \"-X\"") +
          probe("E", "[-15, 10, 20]", "measures = \"-X\"");
  const auto motions = motion_clearances(parse_rig(text, "rig.toml").value()).value();
  EXPECT_EQ(ids(motions[0]), "DE");
  EXPECT_EQ(ids(motions[1]), "");
  EXPECT_EQ(ids(motions[2]), "ABC");
}

}  // namespace
}  // namespace mdof::algo
