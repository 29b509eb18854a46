// Corrections over a plane or a volume. They are compared with results calculated by hand for one
// error at a time, and with the tool position of the true machine.
#include "algo/compensation/volumetric/volumetric.h"

#include <gtest/gtest.h>

#include <cmath>

#include "algo/machine/compensating.h"

namespace mdof::algo {
namespace {

// Text of a machine with X, Y, Z and the tool point at (0, 0, 50) mm; the reference point of the
// errors is the origin. `x`, `y`, `z`: text of the errors of these axes.
std::string machine_text(const std::string& chain, const std::string& x, const std::string& y,
                         const std::string& z) {
  const auto axis = [](const std::string& id, const std::string& errors) {
    return "[[axis]]\nid = \"" + id +
           "\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\nrange_mm = [0, 40]\n" + errors + "\n";
  };
  return "name = \"m\"\nmachine = {chain = \"" + chain + "\"}\ntool = {point_mm = [0, 0, 50]}\n" +
         axis("X", x) + axis("Y", y) + axis("Z", z);
}

// Text of the given errors of an axis; all its other errors are declared as 0.
std::string zero_other_errors(const std::string& axis, const std::string& given) {
  std::string text = given;
  for (const char direction : std::string("XYZABC")) {
    const std::string name = std::string("E") + direction + axis;
    const std::string key = name + (direction < 'D' && direction >= 'A' ? "_urad" : "_um");
    if (given.find(key) == std::string::npos) text += "\n" + key + " = 0";
  }
  return text;
}

Machine machine(const std::string& chain, const std::string& x = "", const std::string& y = "",
                const std::string& z = "") {
  const std::string squares = "EC0Y_urad = 0", leans = "EA0Z_urad = 0\nEB0Z_urad = 0";
  const auto parsed = parse_machine(
      machine_text(
          chain, zero_other_errors("X", x),
          zero_other_errors("Y", y.find("EC0Y") == std::string::npos ? y + "\n" + squares : y),
          zero_other_errors("Z", z.find("0Z") == std::string::npos ? z + "\n" + leans : z)),
      "m.toml");
  EXPECT_TRUE(parsed) << parsed.error().message;
  return *parsed;
}

VolumetricTable built(const Machine& m, const VolumetricRequest& request = {}) {
  const auto table = build_volumetric(m, request);
  EXPECT_TRUE(table) << table.error().message;
  return *table;
}

// A ball screw with a pitch of 10 mm has error values every 2.5 mm. Nodes every 10 mm and the
// centres of the cells do not show its error. EXY has a bend at 1 mm, beside a node; its effect
// adds to that of EXX.
TEST(Volumetric, StatesErrorsBetweenNodes) {
  std::string exx = "EXX_um = [", exy = "EXY_um = [[0, 0], [1, 0.9], [40, 0]]";
  for (int quarter = 0; quarter <= 16; ++quarter)
    exx += "[" + std::to_string(2.5 * quarter) + ", " +
           std::to_string(std::array{0, 10, 0, -10}[static_cast<std::size_t>(quarter % 4)]) + "], ";
  VolumetricRequest request;
  request.step_m = 10e-3;
  const VolumetricTable t = built(machine("w-b-X-Y-Z-t", exx + "]", exy), request);
  EXPECT_NEAR(largest_correction_m(t, 0), 0.69e-6, 0.01e-6);  // EXY at Y = 10 mm
  // The corrected command is beside the peak, on a slope of 4 µm/mm, where EXX is 10/1.004 µm. EXY
  // adds 0.9 µm at Y = 1 mm. The straight line between the nodes contains a part of EXY: a tenth of
  // EXY at Y = 10 mm, which is 0.9 µm · 30/39.
  EXPECT_NEAR(t.interpolation_m[0], (10 / 1.004 + 0.9 - 0.09 * 30 / 39) * 1e-6, 1e-9);
  EXPECT_NEAR(t.interpolation_m[1], 0, 1e-12);
}

TEST(Volumetric, CorrectsErrorsOfToolAndWorkAxes) {
  // EXX is 2 µm at 40 mm, so the body moves 2 µm too far. If the body is the tool, the command is
  // reduced by 2 µm. If the body is the work, it moves against the tool when the command increases.
  // It also moves too far, so the command is reduced by 2 µm in this case, too.
  const std::string exx = "EXX_um = [[0, 0], [40, 2]]";
  for (const char* chain : {"w-b-X-Y-Z-t", "w-X-b-Y-Z-t"}) {
    const VolumetricTable t = built(machine(chain, exx));
    EXPECT_NEAR(t.correction_m[t.node(4, 0, 0)][0], -2e-6, 1e-10) << chain;
    EXPECT_NEAR(t.correction_m[t.node(2, 3, 1)][0], -1e-6, 1e-10) << chain;
    EXPECT_NEAR(t.correction_m[t.node(4, 4, 4)][1], 0, 1e-12) << chain;
  }
  // If X carries the tool, Y moves the tool back by EYX. If X carries the work, Y moves the tool
  // after the work.
  const std::string eyx = "EYX_um = [[0, 0], [40, 4]]";
  const VolumetricTable tool = built(machine("w-b-X-Y-Z-t", eyx));
  EXPECT_NEAR(tool.correction_m[tool.node(4, 1, 2)][1], -4e-6, 1e-10);
  const VolumetricTable work = built(machine("w-X-b-Y-Z-t", eyx));
  EXPECT_NEAR(work.correction_m[work.node(4, 1, 2)][1], +4e-6, 1e-10);
}

TEST(Volumetric, SquarenessCorrectionIsProportionalToTravel) {
  // EC0Y is 100 µrad: at Y = 40 mm the tool is 4 µm too far in the direction -X, and X must add 4
  // µm.
  const VolumetricTable t = built(machine("w-b-X-Y-Z-t", "", "EC0Y_urad = 100"));
  EXPECT_NEAR(t.correction_m[t.node(1, 4, 0)][0], 4e-6, 1e-9);
  EXPECT_NEAR(t.correction_m[t.node(3, 2, 4)][0], 2e-6, 1e-9);
  EXPECT_NEAR(t.correction_m[t.node(0, 0, 4)][0], 0, 1e-12);
}

TEST(Volumetric, AnglesActByTheirLever) {
  // EBX is 50 µrad about +Y; the height of the tool is 50 mm + z. The tool moves in x by EBX (50 mm
  // + z).
  const VolumetricTable t = built(machine("w-b-X-Y-Z-t", "EBX_urad = [[0, 0], [40, 50]]"));
  EXPECT_NEAR(t.correction_m[t.node(4, 0, 0)][0], -50e-6 * 0.050, 1e-9);
  EXPECT_NEAR(t.correction_m[t.node(4, 0, 4)][0], -50e-6 * 0.090, 1e-9);
  EXPECT_NEAR(t.turn_left_rad, 50e-6, 1e-8);  // at the corrected command
  EXPECT_LT(t.place_left_m, 1e-11);
}

TEST(Volumetric, CorrectedToolReachesTheNominalPosition) {
  const Machine m = machine(
      "w-Y-X-b-Z-t", "EXX_um = [[0, 0], [15, 3], [40, -2]]\nECX_urad = [[0, 0], [40, 90]]",
      "EZY_um = [[0, 1], [25, -4], [40, 2]]\nEC0Y_urad = -70\nEAY_urad = [[0, 0], [40, 60]]",
      "EB0Z_urad = 40\nEA0Z_urad = -30\nEYZ_um = [[0, 0], [40, 2]]");
  VolumetricRequest request;
  request.step_m = 0.0025;  // each position of the tables is a node
  const VolumetricTable t = built(m, request);
  double before = 0, after = 0;
  for (const Vec3& at : {Vec3{0.0013, 0.039, 0.021}, {0.033, 0.0072, 0.0388}, {0.0199, 0.02, 0}}) {
    const VolumetricValue v = volumetric_at(t, at);
    EXPECT_TRUE(v.inside);
    Command wanted{at[0], at[1], at[2]}, corrected = wanted;
    for (std::size_t k = 0; k < 3; ++k) corrected[k] += v.correction_m[k];
    const auto place = [&](const Command& c) {
      return actual_tool(m, values_at(m, c, MachineApproach::mean)).p;
    };
    const Eigen::Vector3d nominal = nominal_tool(m, wanted).p;
    before = std::max(before, (place(wanted) - nominal).norm());
    after = std::max(after, (place(corrected) - nominal).norm());
    EXPECT_LT((place(corrected) - nominal).norm(),
              2 * Eigen::Vector3d(t.interpolation_m[0], t.interpolation_m[1], t.interpolation_m[2])
                          .norm() +
                  1e-12);
  }
  EXPECT_GT(before, 2e-6);
  EXPECT_LT(after, before / 500);
}

TEST(Volumetric, UIncludesTheInterpolationBetweenNodes) {
  // The error has a peak of 2 µm at 5 mm, which nodes every 10 mm do not show. u of the error is
  // 0.03 µm.
  const std::string roof = "EXX_um = [[0, 0], [5, 2], [10, 0], [40, 0]]\nu_EXX_um = 0.03";
  VolumetricRequest request;
  request.along = {true, true, false};
  const VolumetricTable t = built(machine("w-b-X-Y-Z-t", roof), request);
  EXPECT_NEAR(t.interpolation_m[0], 2e-6, 1e-9);
  EXPECT_NEAR(t.interpolation_m[1], 0, 1e-12);
  EXPECT_NEAR(volumetric_at(t, {0.01, 0.02, 0}).u_m[0], 0.03e-6, 1e-12);  // (0.01, 0.02) is a node
  EXPECT_NEAR(volumetric_at(t, {0.005, 0.02, 0}).u_m[0], std::sqrt(0.03e-6 * 0.03e-6 + 2e-6 * 2e-6),
              1e-9);
  request.step_m = 0.005;
  EXPECT_LT(built(machine("w-b-X-Y-Z-t", roof), request).interpolation_m[0], 1e-9);
}

TEST(Volumetric, OutsideTheGridTheNearestValueApplies) {
  VolumetricRequest request;
  request.along = {true, true, false};
  request.others[2] = 0.03;  // the table has one command of Z
  const VolumetricTable t = built(machine("w-b-X-Y-Z-t", "EXX_um = [[0, 1], [40, 2]]"), request);
  EXPECT_EQ(t.command_m[2], std::vector<double>{0.03});
  const VolumetricValue end = volumetric_at(t, {0.05, 0.01, 0.03});
  EXPECT_FALSE(end.inside);
  EXPECT_NEAR(end.correction_m[0], -2e-6, 1e-10);
  EXPECT_FALSE(volumetric_at(t, {-0.001, 0.01, 0.03}).inside);
  EXPECT_NEAR(volumetric_at(t, {-0.001, 0.01, 0.03}).correction_m[0], -1e-6, 1e-10);
  EXPECT_TRUE(volumetric_at(t, {0, 0.04, 0.03}).inside);
  EXPECT_TRUE(volumetric_at(t, {0.04, 0, 0.03}).inside);
  // The table has no other command of Z.
  EXPECT_FALSE(volumetric_at(t, {0.02, 0.02, 0.031}).inside);
}

TEST(Volumetric, UnmeasuredErrorsAreRefusedOrNamed) {
  const auto parsed = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-b-X-Y-t\"}\n[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, "
      "0]\npoint = \"moving\"\nrange_mm = [0, 10]\nEXX_um = 1\n[[axis]]\nid = \"Y\"\nholds_at_mm = "
      "[0, 0, 0]\npoint = \"moving\"\nrange_mm = [0, 10]\n",
      "m.toml");
  ASSERT_TRUE(parsed);
  VolumetricRequest request;
  request.along = {true, true, false};
  const auto refused = build_volumetric(*parsed, request);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().remedy, Remedy::allow_incomplete);
  EXPECT_NE(refused.error().message.find("EC0Y"), std::string::npos) << refused.error().message;
  request.incomplete = true;
  const VolumetricTable t = built(*parsed, request);
  EXPECT_NE(std::find(t.not_measured.begin(), t.not_measured.end(), "EYX"), t.not_measured.end());
  EXPECT_EQ(std::find(t.not_measured.begin(), t.not_measured.end(), "EXX"), t.not_measured.end());
  EXPECT_TRUE(std::isnan(t.u_m[0][0]));  // the machine declares no u
}

TEST(Volumetric, ChecksLimitsStepAndRangesOfAxes) {
  const auto code = [](const Machine& m, const VolumetricRequest& request) {
    const auto table = build_volumetric(m, request);
    return table ? std::string("built") : table.error().message;
  };
  const Machine m = machine("w-b-X-Y-Z-t", "EXX_um = [[0, 0], [40, 30]]");
  VolumetricRequest request;
  request.limits.length_m = 29e-6;
  EXPECT_NE(code(m, request).find("limit"), std::string::npos);
  request.limits.length_m = 31e-6;
  EXPECT_EQ(code(m, request), "built");
  request.limits.length_slope = 0.0007;  // the slope is 30 µm in 40 mm, 0.00075
  EXPECT_NE(code(m, request).find("from 0 mm to 10 mm"), std::string::npos) << code(m, request);
  VolumetricRequest fine;
  fine.step_m = 0.0008;  // 51 nodes along each axis
  EXPECT_NE(code(m, fine).find("larger step"), std::string::npos);
  fine.along = {true, true, false};
  fine.step_m = 0.00008;  // 501 nodes along each axis
  EXPECT_NE(code(m, fine).find("more than 500"), std::string::npos);
  fine.step_m = 1e-12;
  EXPECT_NE(code(m, fine).find("larger step"), std::string::npos);
  fine.step_m = 0;
  EXPECT_NE(code(m, fine).find("larger step"), std::string::npos);
  const auto flat = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-b-X-t\"}\n[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, "
      "0]\npoint = \"moving\"\n",
      "m.toml");
  EXPECT_NE(code(*flat, {}).find("neither range_mm"), std::string::npos) << code(*flat, {});
}

}  // namespace
}  // namespace mdof::algo
