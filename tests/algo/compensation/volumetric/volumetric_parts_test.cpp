// The parts of u of a volumetric table are compared with simulated measurements. Matrices in long
// double give the tool position, and the errors are drawn anew in each trial.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "algo/compensation/volumetric/volumetric.h"
#include "algo/machine/compensating.h"
#include "schema/sample.h"
#include "tests/algo/machine/random_machine.h"
#include "tests/coverage_runs.h"

namespace mdof::algo {
namespace {

constexpr double kPartsTravel_m = 0.1;
constexpr int kPartsTrials = 8000;
constexpr double kSpreadTolerance = 0.05;  // six standard deviations of the estimated spread

using NoiseMixing = std::array<std::array<double, kBodyErrors>, kBodyErrors>;

// Effect of each of six independent noise quantities of an axis on each error of this axis, m or
// rad.
struct Axis6 {
  NoiseMixing noise{};
  // Standard uncertainty u of a shift that is the same at all positions of the table.
  std::array<double, kBodyErrors> common{};
};

struct Simulated {
  Machine machine;
  Command others{};  // command of a rotary axis
  std::array<Axis6, 3> axes;
  double u_EC0Y = 3e-6;
};

ErrorCovariance same_everywhere(const Axis6& axis) {
  ErrorCovariance all;
  all.position = {0, kPartsTravel_m};
  all.has.fill(true);
  Covariance6 noise{}, declared{};
  for (std::size_t k = 0; k < kBodyErrors; ++k) {
    declared[k][k] = axis.common[k] * axis.common[k];
    for (std::size_t l = 0; l < kBodyErrors; ++l)
      for (std::size_t q = 0; q < kBodyErrors; ++q)
        noise[k][l] += axis.noise[k][q] * axis.noise[l][q];
  }
  all.noise.assign(2, noise);
  all.declared.assign(2, declared);
  return all;
}

Simulated simulated_axes(unsigned seed, const std::string& rotary = "") {
  test::RandomMachines random(seed);
  Simulated s;
  s.machine = random.machine("XYZ" + rotary, 1e-6, 1e-5, kPartsTravel_m);
  for (MachineFrame& frame : s.machine.frames) {
    if (frame.kind != FrameKind::linear) {
      s.others[3 + frame.direction] = 1.9;
      continue;
    }
    Axis6& axis = s.axes[frame.direction];
    frame.range = {0, kPartsTravel_m};
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      const double size = k < 3 ? 1e-7 : 1e-6;
      double noise = 0;
      for (double& part : axis.noise[k])
        noise = std::hypot(noise, part = random.between(-size, size));
      axis.common[k] = random.between(0, size);
      frame.error[k].u_independent = {noise, noise};
      frame.error[k].u.assign(2, std::hypot(noise, axis.common[k]));
    }
    frame.covariance = same_everywhere(axis);
    if (frame.direction == 1) frame.location[5] = {0.0, s.u_EC0Y};
  }
  return s;
}

Machine simulated_measurement(const Simulated& s, std::mt19937_64& source, bool with_common,
                              bool with_noise) {
  std::normal_distribution<double> normal;
  Machine machine = s.machine;
  for (MachineFrame& frame : machine.frames) {
    if (frame.kind != FrameKind::linear) continue;
    const Axis6& axis = s.axes[frame.direction];
    std::array<std::array<double, kBodyErrors>, 2> parts;
    for (auto& of_position : parts)
      for (double& part : of_position) part = with_noise ? normal(source) : 0;
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      const double shift = with_common ? axis.common[k] * normal(source) : 0;
      for (std::size_t i = 0; i < 2; ++i) {
        frame.error[k].forward[i] += shift;
        for (std::size_t q = 0; q < kBodyErrors; ++q)
          frame.error[k].forward[i] += axis.noise[k][q] * parts[i][q];
      }
    }
    if (frame.direction == 1 && with_common) *frame.location[5].value += s.u_EC0Y * normal(source);
  }
  return machine;
}

struct NodeSpread {
  Vec3 first{}, last{}, product{};  // means over the trials, m²: squares of the deviations at both
                                    // nodes, and their products
};

// Commands of X, Y, Z that move the tool by `place`.
std::array<test::Real, 3> as_commands(const Machine& machine, const Command& at,
                                      const std::array<test::Real, 3>& place) {
  const test::Matrix4 here = test::tool_matrix(machine, at, false);
  test::Matrix4 J = test::same();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Command moved = at;
    moved[axis] += 1;
    const test::Matrix4 there = test::tool_matrix(machine, moved, false);
    for (std::size_t k = 0; k < 3; ++k) J[k][axis] = there[k][3] - here[k][3];
  }
  const test::Matrix4 step = test::times(test::inverse(J), test::shifted(place));
  return {step[0][3], step[1][3], step[2][3]};
}

NodeSpread node_spread(const Simulated& s, unsigned seed, bool with_common, bool with_noise) {
  std::mt19937_64 source(seed);
  const Command first = s.others;
  Command last = s.others;
  std::fill_n(last.begin(), 3, kPartsTravel_m);
  const auto error_at = [&](const Machine& machine, const Command& at) {
    return as_commands(s.machine, at, test::true_error(machine, at).place);
  };
  const auto at_first = error_at(s.machine, first), at_last = error_at(s.machine, last);
  NodeSpread sums;
  for (int trial = 0; trial < kPartsTrials; ++trial) {
    const Machine machine = simulated_measurement(s, source, with_common, with_noise);
    const auto one = error_at(machine, first), other = error_at(machine, last);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto a = static_cast<double>(one[k] - at_first[k]);
      const auto b = static_cast<double>(other[k] - at_last[k]);
      sums.first[k] += a * a / kPartsTrials;
      sums.last[k] += b * b / kPartsTrials;
      sums.product[k] += a * b / kPartsTrials;
    }
  }
  return sums;
}

TEST(VolumetricParts, MatchTheSpreadOfTheirCauses) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    // If a rotary axis is rotated, the directions of the commands differ from the coordinate axes
    // of the work.
    const Simulated s = simulated_axes(seed, seed <= 2 ? "" : seed == 3 ? "C" : "B");
    VolumetricRequest request;
    request.others = s.others;
    request.step_m = kPartsTravel_m;
    request.incomplete = true;
    const auto table = build_volumetric(s.machine, request);
    ASSERT_TRUE(table) << table.error().message;
    ASSERT_EQ(table->nodes(), 8U);
    const NodeSpread all = node_spread(s, seed, true, true),
                     noise = node_spread(s, seed, false, true),
                     common = node_spread(s, seed, true, false);
    for (std::size_t k = 0; k < 3; ++k) {
      const auto near = [&](double variance, double u_m) {
        EXPECT_NEAR(std::sqrt(variance) / u_m, 1, kSpreadTolerance)
            << "seed " << seed << " of " << k;
      };
      near(all.first[k], table->u_m[0][k]);
      near(all.last[k], table->u_m[7][k]);
      near(noise.first[k], table->u_independent_at(0)[k]);
      near(noise.last[k], table->u_independent_at(7)[k]);
      near(common.first[k], table->u_common_at(0)[k]);
      near(common.last[k], table->u_common_at(7)[k]);
      // Two nodes that have no command in common share no noise.
      EXPECT_NEAR(noise.product[k] / std::sqrt(noise.first[k] * noise.last[k]), 0, 0.05);
    }
    const VolumetricValue value = volumetric_at(*table, {0.03, 0.05, 0.07});
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(std::hypot(value.u_common_m[k], value.u_independent_m[k]), value.u_m[k], 1e-15);
  }
}

// Control with a wrong rule: the noise of an axis at two neighbouring nodes is treated as one
// quantity.
double u_with_common_noise(const VolumetricTable& table, const Vec3& part, std::size_t k) {
  double common = 0, noise = 0;
  for (std::size_t node = 0; node < 8; ++node) {
    double weight = 1;
    for (std::size_t axis = 0; axis < 3; ++axis)
      weight *= (node >> axis & 1U) != 0 ? part[axis] : 1 - part[axis];
    common += weight * table.u_common_at(node)[k];
    noise += weight * table.u_independent_at(node)[k];
  }
  return std::hypot(common, noise, table.interpolation_m[k] / std::sqrt(3.0));
}

// Two nodes; three places that are drawn anew in each simulation, inside the cell, on a face and on
// an edge; and the centre of the cell, where the linear interpolation deviates most.
constexpr double kMiddle_m = kPartsTravel_m / 2;
using SixPlaces = std::array<Vec3, 6>;
SixPlaces random_places(std::mt19937_64& source) {
  std::uniform_real_distribution<double> along(0, kPartsTravel_m);
  return {{{0, 0, 0},
           {kPartsTravel_m, kPartsTravel_m, kPartsTravel_m},
           {along(source), along(source), along(source)},
           {along(source), along(source), 0},
           {kPartsTravel_m, along(source), 0},
           {kMiddle_m, kMiddle_m, kMiddle_m}}};
}
using Held = std::array<std::array<int, 3>, 6>;

Vec3 true_correction(const Machine& machine, const Vec3& place) {
  const Command at{place[0], place[1], place[2], 0, 0, 0};
  const auto found = compensating_command(machine, at, MachineApproach::mean);
  Vec3 correction{kNaN, kNaN, kNaN};
  for (std::size_t k = 0; found && k < 3; ++k) correction[k] = found->command[k] - at[k];
  return correction;
}

void count_coverage(const Simulated& s, int simulations, std::mt19937_64& source, Held& held,
                    Held& covered_by_wrong_rule) {
  constexpr double k95 = 1.959964;
  VolumetricRequest request;
  request.step_m = kPartsTravel_m;
  request.incomplete = true;
  for (int n = 0; n < simulations; ++n) {
    const auto table = build_volumetric(simulated_measurement(s, source, true, true), request);
    ASSERT_TRUE(table) << table.error().message;
    const SixPlaces places = random_places(source);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const VolumetricValue value = volumetric_at(*table, places[i]);
      const Vec3 truth = true_correction(s.machine, places[i]);
      Vec3 part = places[i];
      for (double& x : part) x /= kPartsTravel_m;
      for (std::size_t k = 0; k < 3; ++k) {
        const double off = std::abs(value.correction_m[k] - truth[k]);
        held[i][k] += off <= k95 * value.u_m[k] ? 1 : 0;
        covered_by_wrong_rule[i][k] += off <= k95 * u_with_common_noise(*table, part, k);
      }
    }
  }
}

// Required: 94 to 96.5 % of the intervals contain the truth, at nodes and between nodes.
TEST(VolumetricParts, ValuesHoldTheTruth) {
  const int machines = 10, simulations = test::coverage_runs(300);
  Held held{}, wrong_rule_counts{};
  std::mt19937_64 source(test::coverage_seed(8));
  for (unsigned seed = 1; seed <= machines; ++seed)
    count_coverage(simulated_axes(seed), simulations, source, held, wrong_rule_counts);
  int too_often = 0;
  for (std::size_t i = 0; i < held.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const double share = static_cast<double>(held[i][k]) / machines / simulations;
      RecordProperty("held_" + std::to_string(i) + std::to_string(k), std::to_string(share));
      EXPECT_GE(share, 0.94) << i << " of " << k;
      EXPECT_LE(share, 0.965) << i << " of " << k;
      too_often += wrong_rule_counts[i][k] > 0.965 * machines * simulations ? 1 : 0;
    }
  EXPECT_GE(too_often, 9);  // of twelve values between nodes
}

// A node between two targets contains the noise of both targets, so an interpolation between such
// nodes averages less noise. u must equal the spread of the value over many measurements.
TEST(VolumetricParts, GridFinerThanTheTargetsKeepsU) {
  Simulated s = simulated_axes(3);
  VolumetricRequest request;
  request.step_m = kPartsTravel_m;
  request.incomplete = true;
  const auto coarse = build_volumetric(s.machine, request);
  request.step_m = kPartsTravel_m / 4;
  const auto fine = build_volumetric(s.machine, request);
  ASSERT_TRUE(coarse && fine);
  // At the first target, u is the same with both grids. Beside this target the noise of all nodes
  // comes mostly from this target, so the interpolation averages almost nothing.
  const Vec3 at{0.00625, 0.00625, 0.00625};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_NEAR(fine->u_independent_at(0)[k], coarse->u_independent_at(0)[k], 1e-18);
    const double u = volumetric_at(*fine, at).u_independent_m[k];
    const double exact = volumetric_at(*coarse, at).u_independent_m[k];
    EXPECT_GE(u, exact * (1 - 1e-9)) << k;
    EXPECT_LE(u, exact * 1.1) << k;
  }
}

// The noise differs from node to node, and each axis has a different number of nodes. At a node,
// volumetric_at() returns the value of the node.
TEST(VolumetricParts, ValuesAtANodeAreThoseStoredForTheNode) {
  Simulated s = simulated_axes(3);
  for (MachineFrame& frame : s.machine.frames) {
    frame.range = {0, kPartsTravel_m / static_cast<double>(1 + frame.direction)};
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      const double noise = frame.error[k].u_independent[0];
      frame.error[k].u_independent = {noise, 3 * noise};
      frame.error[k].u.assign(2, 4 * noise);
    }
  }
  VolumetricRequest request;
  request.step_m = kPartsTravel_m / 6;
  request.incomplete = true;
  const auto table = build_volumetric(s.machine, request);
  ASSERT_TRUE(table) << table.error().message;
  ASSERT_EQ(table->nodes(), 7U * 4U * 3U);
  for (std::size_t node = 0; node < table->nodes(); ++node) {
    const VolumetricValue read = volumetric_at(*table, table->command_at(node));
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_NEAR(table->u_independent_at(node)[k] / read.u_independent_m[k], 1, 1e-9)
          << node << " of " << k;
  }
}

}  // namespace
}  // namespace mdof::algo
