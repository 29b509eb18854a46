// The values of a volumetric table are compared with three linear interpolations, one axis after
// the other. The residuals that a built table states are compared with errors that add in closed
// form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "algo/compensation/volumetric/volumetric.h"
#include "algo/machine/tool_error.h"
#include "tests/algo/no_pattern.h"

namespace mdof::algo {
namespace {

// A table with 3 x 4 x 2 nodes at uneven commands; its values have no pattern.
VolumetricTable uneven_table() {
  VolumetricTable t;
  t.command_m = {std::vector<double>{-0.01, 0.002, 0.03}, {0, 0.004, 0.01, 0.05}, {0.1, 0.13}};
  test::NoPattern random(5);
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    t.correction_m.push_back({random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)});
    t.u_m.push_back({random.between(1, 2), random.between(1, 2), random.between(1, 2)});
  }
  t.interpolation_m = {0.5, 0.7, 0.2};
  return t;
}

double line(double x, double x0, double x1, double y0, double y1) {
  return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

// Interpolates along X, then along Y, then along Z, in the cell that begins at node (i, j, k).
double by_lines(const VolumetricTable& t, const std::vector<Vec3>& values, const Vec3& at,
                std::size_t i, std::size_t j, std::size_t k) {
  const auto &x = t.command_m[0], &y = t.command_m[1], &z = t.command_m[2];
  const auto along_x = [&](std::size_t row, std::size_t layer) {
    return line(at[0], x[i], x[i + 1], values[t.node(i, row, layer)][k],
                values[t.node(i + 1, row, layer)][k]);
  };
  const auto along_y = [&](std::size_t layer) {
    return line(at[1], y[j], y[j + 1], along_x(j, layer), along_x(j + 1, layer));
  };
  return line(at[2], z[0], z[1], along_y(0), along_y(1));
}

TEST(VolumetricValues, EqualThreeLinearInterpolations) {
  const VolumetricTable t = uneven_table();
  const auto &x = t.command_m[0], &y = t.command_m[1], &z = t.command_m[2];
  test::NoPattern random(6);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const Vec3 at{random.between(x[i], x[i + 1]), random.between(y[j], y[j + 1]),
                    random.between(z[0], z[1])};
      const VolumetricValue v = volumetric_at(t, at);
      EXPECT_TRUE(v.inside);
      for (std::size_t k = 0; k < 3; ++k) {
        EXPECT_NEAR(v.correction_m[k], by_lines(t, t.correction_m, at, i, j, k), 1e-13);
        // The interpolation error of a cell is modelled by a parabola that is 0 at both nodes and 1
        // in the middle between them.
        const auto off = [](double place, double from, double to) {
          return (place - from) * (to - place) / ((to - from) * (to - from) / 4);
        };
        const double share = std::max(
            {off(at[0], x[i], x[i + 1]), off(at[1], y[j], y[j + 1]), off(at[2], z[0], z[1])});
        const double nodes = by_lines(t, t.u_m, at, i, j, k), a = share * t.interpolation_m[k];
        EXPECT_NEAR(v.u_m[k], std::sqrt(nodes * nodes + a * a), 1e-13);
      }
    }
  }
}

TEST(VolumetricValues, AreExactAtNodesAndLinearOnEdges) {
  const VolumetricTable t = uneven_table();
  for (std::size_t node = 0; node < t.nodes(); ++node) {
    const VolumetricValue v = volumetric_at(t, t.command_at(node));
    EXPECT_TRUE(v.inside);
    EXPECT_EQ(v.correction_m, t.correction_m[node]);
    EXPECT_EQ(v.u_m, t.u_m[node]);
  }
  // The last command of X and of Z.
  const VolumetricValue edge = volumetric_at(t, {0.03, 0.0075, 0.13});
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(
        edge.correction_m[k],
        line(7.5, 4, 10, t.correction_m[t.node(2, 1, 1)][k], t.correction_m[t.node(2, 2, 1)][k]),
        1e-13);
    EXPECT_GT(edge.u_m[k], line(7.5, 4, 10, t.u_m[t.node(2, 1, 1)][k], t.u_m[t.node(2, 2, 1)][k]));
  }
}

TEST(VolumetricValues, OneNanometreBesideTheGridIsInside) {
  const VolumetricTable t = uneven_table();
  for (std::size_t k = 0; k < 3; ++k) {
    for (const bool low : {true, false}) {
      Vec3 at{0.002, 0.004, 0.1};
      const double end = low ? t.command_m[k].front() : t.command_m[k].back();
      at[k] = end + (low ? -0.97e-9 : 0.97e-9);
      EXPECT_TRUE(volumetric_at(t, at).inside) << k << low;
      at[k] = end;
      const Vec3 there = volumetric_at(t, at).correction_m;
      at[k] = end + (low ? -1.05e-9 : 1.05e-9);
      EXPECT_FALSE(volumetric_at(t, at).inside) << k << low;
      EXPECT_EQ(volumetric_at(t, at).correction_m, there);
    }
  }
}

// Text of a machine with the axes X, Y, Z, 20 mm of travel and the given errors.
std::string machine_of(const std::string& x, const std::string& y, const std::string& z,
                       const std::string& more = "") {
  std::string text =
      "name = \"small\"\nmachine = {chain = \"w-b-X-Y-Z-t\"}\ntool = {point_mm = [1, 2, 3]}\n" +
      more;
  const std::array<const std::string*, 3> errors{&x, &y, &z};
  for (std::size_t k = 0; k < 3; ++k)
    text += std::string("[[axis]]\nid = \"") + "XYZ"[k] +
            "\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\nrange_mm = [0, 20]\n" + *errors[k] +
            "\n";
  return text;
}

Machine parsed(const std::string& text) {
  const auto machine = parse_machine(text, "m.toml");
  EXPECT_TRUE(machine) << machine.error().message;
  return *machine;
}

TEST(VolumetricTables, InterpolationErrorsOfAllAxesAdd) {
  // EXX, EXY and EXZ have peaks of 1, 2 and 4 µm at 5 mm, between the nodes. Y and Z also have
  // errors in the direction Y.
  const Machine m =
      parsed(machine_of("EXX_um = [[0, 0], [5, 1], [10, 0], [20, 0]]",
                        "EXY_um = [[0, 0], [5, 2], [10, 0], [20, 0]]\nEYY_um = [[0, 0], [15, 3]]",
                        "EXZ_um = [[0, 0], [5, 4], [10, 0], [20, 0]]\n"
                        "EYZ_um = [[0, 0], [10, 0], [15, 0.5], [20, 0]]"));
  VolumetricRequest request;
  request.incomplete = true;
  const auto t = build_volumetric(m, request);
  ASSERT_TRUE(t) << t.error().message;
  EXPECT_NEAR(t->interpolation_m[0], 7e-6, 1e-8);
  // EYY is 3 µm from 15 mm on. The straight line between its nodes at 10 and 20 mm is 2.5 µm at 15
  // mm, 0.5 µm less. EYZ is 0.5 µm above its line in the upper cell; both differences add to 1 µm.
  EXPECT_NEAR(t->interpolation_m[1], 1e-6, 1e-8);
  EXPECT_NEAR(t->interpolation_m[2], 0, 1e-12);
}

TEST(VolumetricTables, StateTheUncorrectedReversal) {
  // EXX is 20 µm higher forward than in reverse, EXY is 6 µm lower. A correction with the mean
  // leaves 10 + 3 µm in X if X and Y approach from different sides; a correction with one approach
  // leaves 20 + 6 µm. The 2 µm of EYX leave 1 µm in Y. Z has no reversal.
  const Machine m =
      parsed(machine_of("EXX_um = [[0, 25, 5], [20, 25, 5]]\n"
                        "EYX_um = [[0, 1, -1], [20, 1, -1]]",
                        "EXY_um = [[0, 0, 6], [20, 0, 6]]", ""));
  VolumetricRequest request;
  request.incomplete = true;
  for (const auto& [approach, part] : {std::pair{MachineApproach::mean, 0.5},
                                       {MachineApproach::forward, 1.0},
                                       {MachineApproach::reverse, 1.0}}) {
    request.approach = approach;
    const auto t = build_volumetric(m, request);
    ASSERT_TRUE(t) << t.error().message;
    EXPECT_NEAR(t->reversal_m[0], part * 26e-6, 1e-10);
    EXPECT_NEAR(t->reversal_m[1], part * 2e-6, 1e-10);
    EXPECT_NEAR(t->reversal_m[2], 0, 1e-12);
  }
  const auto without = build_volumetric(parsed(machine_of("EXX_um = 5", "", "")), request);
  ASSERT_TRUE(without) << without.error().message;
  EXPECT_EQ(without->reversal_m, (Vec3{}));
}

TEST(VolumetricTables, StateTheMachineAndItsUnknownErrors) {
  Machine m = parsed(machine_of("u_EXX_um = 0.3\nEXX_um = [[0, 0], [15, 1]]",
                                "EYY_um = 1\nu_EYY_um = 0.4", "EZZ_um = 1\nu_EZZ_um = 0.5"));
  m.simulated = true;
  VolumetricRequest request;
  request.incomplete = true;
  request.approach = MachineApproach::reverse;
  const auto t = build_volumetric(m, request);
  ASSERT_TRUE(t) << t.error().message;
  EXPECT_EQ(t->name, "small");
  EXPECT_EQ(t->machine.text, "w-b-X-Y-Z-t");
  EXPECT_TRUE(t->simulated);
  EXPECT_EQ(t->noise_only, NoiseOnly::none);
  EXPECT_EQ(t->approach, "reverse");
  EXPECT_EQ(t->tool_m, (Vec3{0.001, 0.002, 0.003}));
  EXPECT_EQ(t->beyond_tables, std::vector<std::string>{"EXX"});  // the table of EXX ends at 15 mm
  const auto has = [](const std::vector<std::string>& names, const char* name) {
    return std::count(names.begin(), names.end(), name);
  };
  EXPECT_EQ(has(t->u_not_declared, "EXX"), 0);
  for (const char* name : {"EYX", "EZX", "EXY", "EZY", "EXZ", "EYZ"})
    EXPECT_EQ(has(t->not_measured, name), 1) << name;
  // The table of EXX ends 5 mm before the node; its slope is 1 µm in 15 mm.
  EXPECT_NEAR(t->u_m[5][0], std::hypot(0.3e-6, 1e-6 * 5 / 15), 1e-12);
  EXPECT_NEAR(t->u_m[5][1], 0.4e-6, 1e-12);
  EXPECT_NEAR(t->u_m[5][2], 0.5e-6, 1e-12);
  m.simulated = false;
  for (auto& frame : m.frames)
    for (auto& error : frame.error) error.noise_only = true;
  request.approach = MachineApproach::forward;
  const auto other = build_volumetric(m, request);
  EXPECT_EQ(other->approach, "forward");
  EXPECT_FALSE(other->simulated);
  EXPECT_EQ(other->noise_only, NoiseOnly::all);
  request.approach = MachineApproach::mean;
  EXPECT_EQ(build_volumetric(m, request)->approach, "mean");
}

TEST(VolumetricTables, UseTheCommandsOfTheOtherAxes) {
  const Machine m =
      parsed(machine_of("EXX_um = [[0, 0], [20, 2]]", "", "EXZ_um = [[0, 0], [20, 4]]"));
  VolumetricRequest request;
  request.incomplete = true;
  request.along = {true, false, false};
  request.others = {0, 0.007, 0.01, 0.1, 0.2, 0.3};
  const auto t = build_volumetric(m, request);
  ASSERT_TRUE(t) << t.error().message;
  EXPECT_EQ(t->rotary_rad, (Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(t->command_m[1], std::vector<double>{0.007});
  EXPECT_EQ(t->command_m[2], std::vector<double>{0.01});
  ASSERT_EQ(t->nodes(), 3u);
  EXPECT_NEAR(t->correction_m[2][0], -4e-6, 1e-9);
  // Y and Z have one command each. A command that differs by rounding in mm is accepted.
  EXPECT_TRUE(volumetric_at(*t, {0.01, 0.007 + 0.5e-9, 0.01 - 0.5e-9}).inside);
  EXPECT_FALSE(volumetric_at(*t, {0.01, 0.007 + 2e-9, 0.01}).inside);
}

TEST(VolumetricTables, UncorrectedPartIsTheLargestOfAllNodes) {
  // A machine with X alone cannot correct EYX, and no axis can correct an angle. ECX is largest in
  // the middle of the travel.
  const Machine m = parsed(
      "name = \"m\"\nmachine = {chain = \"w-b-X-t\"}\n[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, "
      "0]\npoint = \"moving\"\nrange_mm = [0, 20]\nEYX_um = [[0, 1], [10, -4], [20, 2]]\nECX_urad "
      "= [[0, 10], [10, 50], [20, 0]]\nEAX_urad = [[0, 0], [10, 120], [20, 0]]\n");
  VolumetricRequest request;
  request.incomplete = true;
  request.along = {true, false, false};
  const auto t = build_volumetric(m, request);
  ASSERT_TRUE(t) << t.error().message;
  EXPECT_NEAR(t->place_left_m, 4e-6, 1e-10);
  EXPECT_NEAR(t->turn_left_rad, 130e-6, 1e-9);
}

TEST(VolumetricTables, NameTheGridLineThatIsTooSteep) {
  const auto refused = [](const Machine& m, const VolumetricRequest& request) {
    const auto t = build_volumetric(m, request);
    return t ? std::string("built") : t.error().message;
  };
  VolumetricRequest request;
  request.incomplete = true;
  request.limits.length_slope = 0.0003;
  // The error rises by 2 µm in the first 10 mm and by 4 µm in the next 10 mm. Only the second cell
  // is too steep. Tested along each axis in turn.
  const char* steep = "_um = [[0, 0], [10, 2], [20, 6]]";
  const std::array<std::array<std::string, 2>, 3> all{
      {{"EYX", "the correction of Y along X from X 0 Y 0 Z 0 mm"},
       {"EZY", "the correction of Z along Y from X 0 Y 0 Z 0 mm"},
       {"EXZ", "the correction of X along Z from X 0 Y 0 Z 0 mm"}}};
  for (std::size_t k = 0; k < 3; ++k) {
    std::array<std::string, 3> errors;
    errors[k] = all[k][0] + steep;
    const std::string said = refused(parsed(machine_of(errors[0], errors[1], errors[2])), request);
    EXPECT_NE(said.find(all[k][1]), std::string::npos) << said;
    EXPECT_NE(said.find("from 10 mm to 20 mm"), std::string::npos) << said;
  }
  request.limits.length_slope = 0.0005;
  EXPECT_EQ(refused(parsed(machine_of("", std::string("EZY") + steep, "")), request), "built");
  // The correction of X along Y follows from ECX. It is too steep only at the end of the travel of
  // X.
  request.limits.length_slope = 0.00097;
  const Machine turned = parsed(machine_of("ECX_urad = [[0, 900], [10, 940], [20, 1000]]", "", ""));
  const std::string said = refused(turned, request);
  EXPECT_NE(said.find("along Y from X 20 Y 0 Z 0 mm"), std::string::npos) << said;
  EXPECT_NE(said.find("the correction of X"), std::string::npos) << said;
}

TEST(VolumetricTables, HaveAtMostFiveHundredCommandsAnAxis) {
  const Machine m = parsed(machine_of("", "", ""));
  VolumetricRequest request;
  request.incomplete = true;
  request.along = {true, false, false};
  request.step_m = 0.02 / 498.9;
  const auto most = build_volumetric(m, request);
  ASSERT_TRUE(most) << most.error().message;
  EXPECT_EQ(most->nodes(), 500u);
  request.step_m = 0.02 / 499.1;
  EXPECT_FALSE(build_volumetric(m, request));
}

}  // namespace
}  // namespace mdof::algo
