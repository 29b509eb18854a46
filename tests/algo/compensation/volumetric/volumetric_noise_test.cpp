// Noise of the axis tables in a volumetric table, compared with values calculated by hand.
#include "algo/compensation/volumetric/volumetric_noise.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "algo/machine/tool_error.h"

namespace mdof::algo::axis_noise {
namespace {

double form(const AxisNoise::SquareForm& c, double p, double q) {
  return c[0] + c[1] * p + c[2] * q + c[3] * p * p + c[4] * p * q + c[5] * q * q;
}

// Expected variance of Y and Z between two nodes with the variances V0 and V1 and the covariance C:
// (1-part)² V0 + 2 part (1-part) C + part² V1. Beyond the grid, the command of X at its end
// applies.
TEST(VolumetricNoise, IsInterpolatedForEachAxis) {
  VolumetricTable table;
  table.command_m = {std::vector<double>{0.2, 0.5}, {0.1, 0.4, 0.9}, {-0.3, 0.7}};
  double next = 3;
  const auto fill = [&](std::array<AxisNoise::SquareForm, 3>& forms) {
    for (auto& of_component : forms)
      for (double& c : of_component) c = next = std::fmod(next * 1.37 + 2.1, 7) + 0.4;
  };
  table.noise[1].resize(3);
  table.noise[2].resize(2);
  for (const std::size_t axis : {1, 2})
    for (AxisNoise& node : table.noise[axis]) {
      fill(node.variance);
      fill(node.covariance_with_next);
    }
  const std::array<GridCell, 3> cell{{{0, 0.6, true}, {1, 0.3, true}, {0, 0.8, true}}};
  const auto& [y0, y1] = std::tie(table.noise[1][1], table.noise[1][2]);
  const auto& [z0, z1] = std::tie(table.noise[2][0], table.noise[2][1]);
  for (const double x : {0.35, 1.5, -1.0}) {
    const double at_x = x > 1 ? 0.5 : x < 0 ? 0.2 : x, y = 0.55, z = 0.45;
    const Vec3 variance = noise_variance(table, cell, {x, y, z});
    for (std::size_t k = 0; k < 3; ++k) {
      const double of_y = 0.49 * form(y0.variance[k], at_x, z) +
                          0.42 * form(y0.covariance_with_next[k], at_x, z) +
                          0.09 * form(y1.variance[k], at_x, z);
      const double z_part_variance = 0.04 * form(z0.variance[k], at_x, y) +
                                     0.32 * form(z0.covariance_with_next[k], at_x, y) +
                                     0.64 * form(z1.variance[k], at_x, y);
      EXPECT_NEAR(variance[k], of_y + z_part_variance, 1e-12) << x << k;
    }
  }
  // The last node has no next node.
  const Vec3 last =
      noise_variance(table, {{{0, 0, true}, {2, 0, true}, {1, 0, true}}}, {0.35, 0.9, 0.7});
  for (std::size_t k = 0; k < 3; ++k)
    EXPECT_NEAR(last[k],
                form(table.noise[1][2].variance[k], 0.35, 0.7) +
                    form(table.noise[2][1].variance[k], 0.35, 0.9),
                1e-12);
  for (auto& forms : {&table.noise[1][2].variance, &table.noise[2][1].variance})
    forms->fill({-1, 0, 0, 0, 0, 0});
  EXPECT_EQ(noise_variance(table, {{{0, 0, true}, {2, 0, true}, {1, 0, true}}}, {0.35, 0.9, 0.7}),
            Vec3{});  // a negative variance comes from rounding and becomes 0
}

// EYX and ECX of X are measured at targets at 0, 10 and 20 mm; the nodes are at 4, 7 and 13 mm. The
// nodes at 4 and 7 mm share the noise of the targets at 0 mm (0.6 · 0.3) and 10 mm (0.4 · 0.7). The
// nodes at 7 and 13 mm share the noise of the target at 10 mm (0.7 · 0.7). The correlation of EYX
// and ECX is 0.2 at 0 mm, -0.1 at 10 mm, -0.6 at 20 mm.
TEST(VolumetricNoise, NodesShareTheNoiseOfCommonTargets) {
  auto machine = parse_machine(
      "name = \"m\"\nmachine = {chain = \"w-b-X-Y-Z-t\"}\ntool = {point_mm = [40, 30, 20]}\n"
      "[[axis]]\nid = \"X\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\nrange_mm = [0, 20]\n"
      "[[axis]]\nid = \"Y\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n"
      "[[axis]]\nid = \"Z\"\nholds_at_mm = [0, 0, 0]\npoint = \"moving\"\n",
      "m.toml");
  ASSERT_TRUE(machine) << machine.error().message;
  const std::size_t x = static_cast<std::size_t>(machine->find("X") - machine->frames.data());
  MachineFrame& frame = machine->frames[x];
  const std::vector<double> targets = {0, 0.01, 0.02}, u_yx = {2e-7, 3e-7, 7e-7},
                            u_cx = {4e-6, 5e-6, 11e-6};
  for (const std::size_t k : {1, 5}) {
    frame.error[k].position = targets;
    frame.error[k].forward = {1e-7, 2e-7, 4e-7};
    frame.error[k].u = frame.error[k].u_independent = k == 1 ? u_yx : u_cx;
  }
  ErrorCovariance& known = frame.covariance;
  known.position = targets;
  known.has[1] = known.has[5] = true;
  known.declared.resize(3);
  for (std::size_t i = 0; i < 3; ++i) {
    Covariance6& at = known.noise.emplace_back();
    at[1][1] = u_yx[i] * u_yx[i];
    at[5][5] = u_cx[i] * u_cx[i];
    at[1][5] = at[5][1] = std::array{0.2, -0.1, -0.6}[i] * u_yx[i] * u_cx[i];
  }
  VolumetricTable table;
  table.command_m = {std::vector<double>{0.004, 0.007, 0.013}, {0}, {0}};
  set_axis_noise(table, *machine, {}, MachineApproach::forward);
  ASSERT_EQ(table.noise[0].size(), 3u);
  EXPECT_TRUE(table.noise[1].empty() && table.noise[2].empty());

  const auto on_y = [&](double at_m, std::size_t k) {
    for (const ErrorDerivative& d : derivatives(*machine, {at_m}))
      if (d.frame == x && d.k == k && !d.of_line) return d.d(1);
    return std::nan("");
  };
  const auto shared = [&](double at_m, double there_m, std::size_t t, double r) {
    const double y = u_yx[t], c = u_cx[t];
    return on_y(at_m, 1) * on_y(there_m, 1) * y * y + on_y(at_m, 5) * on_y(there_m, 5) * c * c +
           (on_y(at_m, 1) * on_y(there_m, 5) + on_y(at_m, 5) * on_y(there_m, 1)) * r * y * c;
  };
  const double first = 0.18 * shared(0.004, 0.007, 0, 0.2) + 0.28 * shared(0.004, 0.007, 1, -0.1);
  const double second = 0.49 * shared(0.007, 0.013, 1, -0.1);
  EXPECT_GT(std::abs(second), 1e-15);
  EXPECT_NEAR(table.noise[0][0].covariance_with_next[1][0] / first, 1, 1e-12);
  EXPECT_NEAR(table.noise[0][1].covariance_with_next[1][0] / second, 1, 1e-12);
  // If the covariance of EYX and ECX is unknown, both errors are independent, each with its own
  // targets.
  known = {};
  frame.error[5].position[2] = 0.021;
  set_axis_noise(table, *machine, {}, MachineApproach::forward);
  EXPECT_NEAR(table.noise[0][1].covariance_with_next[1][0] /
                  (0.49 * (on_y(0.007, 1) * on_y(0.013, 1) * 9e-14 +
                           on_y(0.007, 5) * on_y(0.013, 5) * 25e-12 * (8.0 / 11 / 0.7))),
              1, 1e-12);
}

}  // namespace
}  // namespace mdof::algo::axis_noise
