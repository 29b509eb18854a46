// The map of a plane is compared with a separate calculation of each point.
#include "algo/machine/plane_map.h"

#include <gtest/gtest.h>

#include "tests/algo/machine/random_machine.h"

namespace mdof::algo {
namespace {

// Limits of the differences. 1e-14 m is also the limit of a single point against long double;
// kSameU is relative.
constexpr double kSameError_m = 1e-14, kSameU = 1e-9;

// Declares u of tables and of axis lines. Some errors are correlated, some have no declared u.
void declare_u(Machine& machine, test::RandomMachines& random) {
  for (MachineFrame& frame : machine.frames) {
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      for (std::size_t i = 0; i < frame.error[k].forward.size(); ++i)
        if (random.between(0, 1) < 0.8) frame.error[k].u.push_back(random.between(0, 1e-6));
      if (frame.error[k].u.size() != frame.error[k].forward.size()) frame.error[k].u.clear();
      if (frame.location[k].value) frame.location[k].u = random.between(0, 1e-6);
    }
    if (frame.kind != FrameKind::linear) continue;
    ErrorCovariance& all = frame.covariance;
    all.position = {0, 0.3};
    for (std::size_t p = 0; p < 3; ++p) {  // quantities common to the axes: the scale of a probe
      SharedPart& part = all.shared.emplace_back();
      part.at.resize(2);
      for (auto& at : part.at)
        for (double& e : at) e = random.between(-3e-7, 3e-7);
    }
    for (std::size_t k = 0; k < kBodyErrors; ++k) all.has[k] = !frame.error[k].u.empty();
    for (auto* by_position : {&all.noise, &all.declared})
      for (std::size_t i = 0; i < 2; ++i) {
        const double rho = random.between(-0.15, 0.95);
        Covariance6& matrix = by_position->emplace_back();
        for (std::size_t k = 0; k < kBodyErrors; ++k)
          for (std::size_t l = 0; l < kBodyErrors; ++l)
            if (all.has[k] && all.has[l])
              matrix[k][l] = (k == l ? 1 : rho) * frame.error[k].u[0] * frame.error[l].u[0];
      }
  }
}

struct LargestOfMap {
  double error_m = 0, u = 0;
};

void compare_with_points(const Machine& machine, const PlaneMapRequest& request,
                         LargestOfMap& worst) {
  const auto map = plane_map(machine, request);
  ASSERT_TRUE(map) << map.error().message;
  Eigen::Vector3d largest_u = Eigen::Vector3d::Zero();
  std::vector<ToolError> alone;
  Command command = request.others;
  for (std::size_t i = 0; i < map->points.size(); ++i) {
    command[request.first] = map->first_at(i);
    command[request.second] = map->second_at(i);
    alone.push_back(tool_error(machine, command, request.approach));
    for (Eigen::Index k = 0; k < 3; ++k)
      if (alone.back().u[k] > largest_u[k]) largest_u[k] = alone.back().u[k];
  }
  for (std::size_t i = 0; i < alone.size(); ++i)
    for (Eigen::Index k = 0; k < 3; ++k) {
      const PlanePoint& p = map->points[i];
      worst.error_m = std::max(worst.error_m, std::abs(p.error[k] - alone[i].exact[k]));
      ASSERT_EQ(std::isnan(p.u[k]), std::isnan(alone[i].u[k]));
      if (!std::isnan(p.u[k]))
        worst.u = std::max(worst.u, std::abs(p.u[k] - alone[i].u[k]) / largest_u[k]);
    }
}

TEST(PlaneMap, MatchesItsSinglePoints) {
  test::RandomMachines random(11);
  LargestOfMap worst;
  for (int i = 0; i < 300; ++i) {
    auto machine = random.machine(i % 2 ? "XYZACmnop" : "XYZ", 50e-6, 1e-3, 0.3);
    declare_u(machine, random);
    PlaneMapRequest request;
    request.first = i % 3 == 2 ? 1 : 0;
    request.second = i % 3 == 0 ? 1 : 2;
    request.step_m = 0.07;
    request.others = random.command(0.3);
    request.approach = i % 4 ? MachineApproach::mean : MachineApproach::reverse;
    compare_with_points(machine, request, worst);
  }
  RecordProperty("worst_error_m", std::to_string(worst.error_m * 1e15) + "e-15");
  RecordProperty("worst_u", std::to_string(worst.u * 1e12) + "e-12");
  EXPECT_LT(worst.error_m, kSameError_m);
  EXPECT_LT(worst.u, kSameU);
}

// At the first corner the lever of ECX is 0, at the others it is not. The map must still report
// that u of ECX is unknown.
TEST(PlaneMap, NamesErrorsThatActAtAnyCorner) {
  Machine m;
  m.frames.resize(2);
  m.frames[0].id = "X";
  m.frames[1].id = "Y";
  m.frames[1].direction = 1;
  for (auto& f : m.frames) {
    f.kind = FrameKind::linear;
    f.range = {0, 0.1};
    for (auto& e : f.error) e.forward = {0};
  }
  // EYX, whose table ends at 50 mm.
  m.frames[0].error[1] = {{0, 0.05}, {0, 1e-6}, {}, {1e-7, 1e-7}, {}};
  m.frames[1].error[5].forward.clear();  // ECY, not measured
  PlaneMapRequest request;
  request.step_m = 0.05;
  const auto map = plane_map(m, request);
  ASSERT_TRUE(map) << map.error().message;
  EXPECT_EQ(map->beyond, std::vector<std::string>{"EYX"});
  EXPECT_NE(std::find(map->no_u.begin(), map->no_u.end(), "ECX"), map->no_u.end());
  EXPECT_NE(std::find(map->not_measured.begin(), map->not_measured.end(), "ECY"),
            map->not_measured.end());
  EXPECT_TRUE(std::isnan(map->points[0].u[0]));
  EXPECT_NEAR(map->points[0].u[1], 1e-7, 1e-20);
}

// Without angles, the errors and covariances of positions remain, and those of angles are 0.
TEST(PlaneMap, WithoutAnglesKeepsThePositions) {
  test::RandomMachines random(12);
  Machine whole = random.machine("XYZ", 50e-6, 1e-3, 0.3);
  declare_u(whole, random);
  const Machine without = without_angles(whole);
  ASSERT_EQ(without.frames.size(), whole.frames.size());
  for (std::size_t i = 0; i < whole.frames.size(); ++i) {
    const MachineFrame &of = whole.frames[i], &found = without.frames[i];
    for (std::size_t k = 0; k < kBodyErrors; ++k) {
      const bool is_angle = k >= 3;
      EXPECT_EQ(found.error[k].forward, is_angle ? std::vector<double>{0} : of.error[k].forward);
      EXPECT_EQ(found.error[k].u, is_angle ? std::vector<double>{0} : of.error[k].u);
      EXPECT_EQ(found.error[k].position, is_angle ? std::vector<double>{} : of.error[k].position);
      EXPECT_TRUE(!is_angle ||
                  (found.error[k].reverse.empty() && found.error[k].curvature.empty()));
      EXPECT_EQ(found.location[k].value, of.location[k].value);
      for (std::size_t l = 0; l < kBodyErrors; ++l)
        for (std::size_t at = 0; at < of.covariance.noise.size(); ++at) {
          const bool has_angle = is_angle || l >= 3;
          EXPECT_EQ(found.covariance.noise[at][k][l],
                    has_angle ? 0 : of.covariance.noise[at][k][l]);
          EXPECT_EQ(found.covariance.declared[at][k][l],
                    has_angle ? 0 : of.covariance.declared[at][k][l]);
        }
      ASSERT_EQ(found.covariance.shared.size(), 3u);
      for (std::size_t p = 0; p < 3; ++p)
        for (std::size_t at = 0; at < 2; ++at)
          EXPECT_EQ(found.covariance.shared[p].at[at][k],
                    is_angle ? 0 : of.covariance.shared[p].at[at][k]);
    }
  }
}

}  // namespace
}  // namespace mdof::algo
