#include "algo/machine/tool_error.h"

#include <gtest/gtest.h>

#include "algo/machine/compensating.h"
#include "tests/algo/machine/random_machine.h"

namespace mdof::algo {
namespace {

const char* const kChains[] = {"XYZ", "XYZC", "XYZAC", "XYZABC", "XYZmn", "XY", "XYZCmnopqrstuv"};

// Largest permitted difference over 10,000 random machines: 1e-14 m and 1e-14 rad.
TEST(MachineModel, MatchesTheProductOfMatrices) {
  test::RandomMachines random(1);
  double worst_place = 0, worst_angle = 0;
  for (int i = 0; i < 10000; ++i) {
    const auto machine = random.machine(kChains[i % 7], 50e-6, 1e-3, 0.3);
    const auto command = random.command(0.3);
    const auto truth = test::true_error(machine, command);
    const auto error =
        exact_error(machine, command, values_at(machine, command, MachineApproach::mean));
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at = static_cast<Eigen::Index>(k);
      worst_place =
          std::max(worst_place, std::abs(error[at] - static_cast<double>(truth.place[k])));
      worst_angle =
          std::max(worst_angle, std::abs(error[at + 3] - static_cast<double>(truth.angle[k])));
    }
  }
  RecordProperty("worst_place_m", std::to_string(worst_place * 1e15) + "e-15");
  EXPECT_LT(worst_place, 1e-14);
  EXPECT_LT(worst_angle, 1e-14);
}

TEST(MachineModel, LinearErrorIsWithinItsBound) {
  test::RandomMachines random(2);
  double closest = 0;
  for (int i = 0; i < 4000; ++i) {
    const double turn = random.between(1e-5, 5e-3);
    const auto machine = random.machine(kChains[i % 7], 50e-6, turn, 0.3);
    const auto command = random.command(0.3);
    const auto e = tool_error(machine, command, MachineApproach::mean);
    const double place = (e.exact - e.linear).head<3>().norm();
    const double angle = (e.exact - e.linear).tail<3>().norm();
    EXPECT_LE(place, e.bound.place_m);
    EXPECT_LE(angle, e.bound.angle_rad);
    closest = std::max(closest, place / e.bound.place_m);
  }
  EXPECT_GT(closest, 0.02);  // one difference must be above 2 % of its bound
}

// The declared u of all errors that affect the position is 0, so u is 0. If one of them has no
// declared u, u is unknown.
TEST(MachineModel, DeclaredZeroIsAKnownU) {
  Machine machine = test::RandomMachines(9).machine("XYZ", 0, 0, 0.3);
  for (MachineFrame& frame : machine.frames) {
    for (ErrorFunction& error : frame.error) error = {{}, {0}, {}, {0}, {}};
    for (LocationError& error : frame.location)
      if (error.value) error.u = 0;
  }
  const Command command = test::RandomMachines(9).command(0.3);
  EXPECT_EQ(tool_error(machine, command, MachineApproach::mean).u[0], 0);
  machine.frames[1].error[0].u.clear();
  machine.frames[2].error[0].u.clear();
  EXPECT_TRUE(std::isnan(tool_error(machine, command, MachineApproach::mean).u[0]));
}

// Tests one error at a time. The expected derivative is the slope of the exact error, by
// differences of fourth order at several distances h; their errors are h^4/30 and rounding/h.
// Limit: 1e-9 of the derivative.
TEST(MachineModel, DerivativesMatchDifferencesOfTheExactError) {
  test::RandomMachines random(3);
  double worst = 0;
  for (int i = 0; i < 70; ++i) {
    auto machine = random.machine(kChains[i % 7], 0, 0, 0.3);
    const auto command = random.command(0.3);
    for (const auto& d : derivatives(machine, command)) {
      auto& frame = machine.frames[d.frame];
      const auto with = [&](double value) {
        const auto before = frame;
        if (d.of_line)
          frame.location[d.k].value = value;
        else
          frame.error[d.k] = {{}, {value}, {}, {}, {}};
        auto e = exact_error(machine, command, values_at(machine, command, MachineApproach::mean));
        frame = before;
        return e;
      };
      constexpr double h = 1e-3;
      const Vector6 slope = (8 * (with(h) - with(-h)) - (with(2 * h) - with(-2 * h))) / (12 * h);
      const double size = std::max(d.d.cwiseAbs().maxCoeff(), slope.cwiseAbs().maxCoeff());
      if (size < 1e-12) continue;
      worst = std::max(worst, (slope - d.d).cwiseAbs().maxCoeff() / std::max(size, 0.01));
    }
  }
  RecordProperty("worst_relative", std::to_string(worst * 1e12) + "e-12");
  EXPECT_LT(worst, 1e-9);
}

// A machine with X, which carries the work or the tool, and Z; the tool is at z = 100 mm. Signs and
// levers are calculated by hand.
Machine by_hand(bool x_carries_work) {
  Machine m;
  m.frames.resize(2);
  m.frames[0].id = "X";
  m.frames[0].kind = FrameKind::linear;
  m.frames[0].carries_work = x_carries_work;
  m.frames[1].id = "Z";
  m.frames[1].kind = FrameKind::linear;
  m.frames[1].direction = 2;
  m.tool_m = {0, 0, 0.1};
  return m;
}

TEST(MachineModel, SignsAndLeversByHand) {
  for (const bool work : {true, false}) {
    const double side = work ? -1 : 1;
    auto m = by_hand(work);
    const Command at = {0.05, 0, 0.02, 0, 0, 0};
    const auto error_of = [&](std::size_t k, double value, bool moves) {
      auto one = m;
      one.frames[0].error[k].forward = {value};
      one.frames[0].point_moves = moves;
      return tool_error(one, at, MachineApproach::mean).linear;
    };
    EXPECT_NEAR(error_of(1, 1e-6, false)[1], side * 1e-6, 1e-15);  // EYX
    // EBX rotates about the origin of the machine; the tool is 120 mm above it.
    EXPECT_NEAR(error_of(4, 1e-6, false)[0], side * 0.12e-6, 1e-15);
    // If X carries the tool, the tool has moved 50 mm along X. If X carries the work, it has not
    // moved.
    EXPECT_NEAR(error_of(4, 1e-6, false)[2], work ? 0 : -0.05e-6, 1e-15);
    EXPECT_NEAR(error_of(4, 1e-6, true)[2], work ? -0.05e-6 : 0, 1e-15);
    EXPECT_NEAR(error_of(4, 1e-6, true)[4], side * 1e-6, 1e-15);
  }
}

// The angle from +X to +Y is 90° + EC0Y, so the line of Y is tilted towards -X.
TEST(MachineModel, SquarenessHasTheSignOfItsName) {
  auto m = by_hand(false);
  m.frames[1].id = "Y";
  m.frames[1].direction = 1;
  m.frames[1].location[5].value = 10e-6;
  const Command at = {0, 0.1, 0, 0, 0, 0};
  const auto e = tool_error(m, at, MachineApproach::mean);
  EXPECT_NEAR(e.exact[0], -1e-6, 1e-14);
  EXPECT_NEAR(e.linear[0], -1e-6, 1e-18);
  EXPECT_EQ(e.exact[5], 0);  // the tilt of an axis line rotates no body
  EXPECT_EQ(e.no_u[0], std::vector<std::string>{"EC0Y"});
}

TEST(MachineModel, NamesUnmeasuredErrors) {
  auto m = by_hand(true);
  m.frames[0].error[0].forward = {1e-6};
  const auto e = tool_error(m, {0.05, 0, 0.02, 0, 0, 0}, MachineApproach::mean);
  const auto& x = e.not_measured[0];
  const auto named = [&x](const char* name) { return std::count(x.begin(), x.end(), name) == 1; };
  EXPECT_TRUE(named("EBX") && named("EXZ") && named("EBZ") && named("EB0Z"));
  EXPECT_FALSE(named("EXX") || named("EYX") || named("EB0X"));
  EXPECT_EQ(e.no_u[0], std::vector<std::string>{"EXX"});
}

TEST(MachineModel, HoldsTheLastValueAndReportsTheEndOfATable) {
  auto m = by_hand(false);
  m.frames[0].error[0] = {{0, 0.04}, {0, 4e-6}, {0, 6e-6}, {}, {}};
  const auto at = [&](double x_m, MachineApproach approach) {
    return tool_error(m, {x_m, 0, 0, 0, 0, 0}, approach);
  };
  EXPECT_NEAR(at(0.01, MachineApproach::forward).exact[0], 1e-6, 1e-15);
  EXPECT_NEAR(at(0.01, MachineApproach::reverse).exact[0], 1.5e-6, 1e-15);
  EXPECT_NEAR(at(0.01, MachineApproach::mean).exact[0], 1.25e-6, 1e-15);
  EXPECT_TRUE(at(0.04, MachineApproach::forward).beyond.empty());
  const auto beyond = at(0.05, MachineApproach::forward);
  EXPECT_NEAR(beyond.exact[0], 4e-6, 1e-15);
  EXPECT_EQ(beyond.beyond, std::vector<std::string>{"EXX"});
}

// An axis never stops exactly at its target. Positions up to 2 % of an interval beyond the end are
// accepted, as for a compensation table.
TEST(MachineModel, StopNearTheEndIsNotBeyond) {
  const std::vector<double> position{-0.01, 0, 0.04};
  for (const auto& [at_m, beyond] : {std::pair(-0.01 - 0.19e-3, false),
                                     {-0.01 - 0.21e-3, true},
                                     {0.04 + 0.79e-3, false},
                                     {0.04 + 0.81e-3, true}}) {
    const TablePlace place = place_of(position, at_m);
    EXPECT_EQ(place.beyond, beyond) << at_m;
    EXPECT_EQ(value_at({1, 2, 3}, place), at_m < 0 ? 1 : 3) << at_m;
  }
}

// At the position where an angle is set to 0, the angle and its u are 0.
TEST(MachineModel, UIsLinearBetweenPositions) {
  auto m = by_hand(false);
  MachineFrame& x = m.frames[0];
  x.error[1] = {{0, 0.1}, {0, 0}, {}, {1e-7, 3e-7}, {}};
  x.error[5] = {{0, 0.1}, {0, 0}, {}, {0, 5e-6}, {}};
  x.error[1].curvature = x.error[5].curvature = {0.0};
  x.covariance.position = {0, 0.1};
  x.covariance.has[1] = x.covariance.has[5] = true;
  x.covariance.noise.resize(2);
  x.covariance.declared.resize(2);
  x.covariance.noise[0][1][1] = 1e-14;
  x.covariance.noise[1][1][1] = 9e-14;
  auto& declared = x.covariance.declared[1];
  declared[5][5] = 25e-12;
  for (const auto& [at_m, u_place, u_angle] : {std::tuple(0.0, 1e-7, 0.0),
                                               {1e-9, 1e-7, 5e-14},
                                               {0.025, 1.5e-7, 1.25e-6},
                                               {0.1 - 1e-9, 3e-7, 5e-6},
                                               {0.1, 3e-7, 5e-6},
                                               {0.1 + 1e-9, 3e-7, 5e-6}}) {
    const FrameValues v = values_at(x, {at_m, 0, 0, 0, 0, 0}, MachineApproach::mean);
    EXPECT_NEAR(v.u_parts.row(1).norm(), u_place, 1e-14) << at_m;
    EXPECT_NEAR(v.u_parts.row(5).norm(), u_angle, 1e-12) << at_m;
    EXPECT_NEAR(v.noise_parts.row(1).norm(), u_place, 1e-14) << at_m;
  }
}

// Beyond an end the end value is held, so u contains the larger slope of both approaches. GUM 5.2.2
// with the change of the true error over 1 mm: 20 and 50 nm.
TEST(MachineModel, UBeyondAnEndContainsTheSlope) {
  auto m = by_hand(false);
  MachineFrame& x = m.frames[0];
  x.error[1] = {{0, 0.1}, {0, 2e-6}, {0, -5e-6}, {3e-8, 3e-8}, {}};
  const auto u = [&](double at_m) {
    return values_at(x, {at_m, 0, 0, 0, 0, 0}, MachineApproach::mean).u_parts.row(1).norm();
  };
  EXPECT_NEAR(u(0.05), 3e-8, 1e-14);
  for (const double at_m : {-1e-3, 0.101}) EXPECT_NEAR(u(at_m), std::hypot(3e-8, 5e-8), 1e-14);
  x.error[1].curvature = {1e-3};  // the parabola 0.5e-3 x² bends by 50.5 nm over 1 mm beyond 0.1 m
  EXPECT_NEAR(u(0.101), std::hypot(3e-8, 5e-8, 0.5 * 1e-3 * 0.101 * 1e-3), 1e-14);
}

// To second order the bound is 2 · rotations · shifts. A shifted line of a rotary axis counts
// twice, because the frame moves to the line and back. A shifted line of a linear axis counts once.
TEST(MachineModel, BoundCountsAShiftedRotaryLineTwice) {
  test::RandomMachines random(6);
  const auto machine = random.machine("XYZC", 0, 0, 0.3);
  const auto command = random.command(0.3);
  constexpr double kTurn = 1e-3, kShift_m = 10e-6;
  const auto bound = [&](FrameKind kind, double shift_m) {
    auto m = machine;
    for (MachineFrame& frame : m.frames) {
      if (frame.id == "X") frame.error[3] = {{}, {kTurn}, {}, {}, {}};
      if (frame.kind == kind && (kind == FrameKind::rotary || frame.id == "Y"))
        frame.location[0].value = shift_m;
    }
    return linear_bound(m, command, values_at(m, command, MachineApproach::mean)).place_m;
  };
  for (const auto& [kind, times] : {std::pair{FrameKind::rotary, 2.0}, {FrameKind::linear, 1.0}})
    EXPECT_NEAR(bound(kind, kShift_m) - bound(kind, 0),
                2 * kTurn * times * kShift_m * (1 + 4 * kTurn), 1e-15);
}

TEST(MachineModel, UncertaintyIsTheRootSumOfSquares) {
  auto m = by_hand(true);
  m.frames[0].error[0] = {{}, {1e-6}, {}, {0.3e-6}, {}};
  m.frames[0].error[4] = {{}, {0}, {}, {2e-6}, {}};  // acts with a lever of 120 mm
  m.frames[1].location[4] = {0, 5e-6};               // acts over 20 mm
  const auto e = tool_error(m, {0.05, 0, 0.02, 0, 0, 0}, MachineApproach::mean);
  EXPECT_NEAR(e.u[0], std::hypot(0.3e-6, 0.24e-6, 0.1e-6), 1e-15);
  EXPECT_NEAR(e.u[4], 2e-6, 1e-15);
}

// Limit of the residual: 1 pm for errors of 50 µm and 200 µrad in a cube of 100 mm.
TEST(Compensating, CorrectsThePositionCompletely) {
  test::RandomMachines random(4);
  double worst = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto machine = random.machine(i % 2 == 0 ? "XYZ" : "XYZC", 50e-6, 200e-6, 0.1);
    auto wanted = random.command(0.098);
    // At least 1 mm inside the ends of the tables.
    for (std::size_t k = 0; k < 3; ++k) wanted[k] += 0.001;
    wanted[5] /= 10;  // at a quarter turn of C two linear axes can be parallel
    const auto c = compensating_command(machine, wanted, MachineApproach::mean);
    ASSERT_TRUE(c);
    EXPECT_TRUE(c->converged);
    EXPECT_LE(c->steps, 8);
    // The expected position is calculated by the independent matrices.
    const auto reached = test::tool_matrix(machine, c->command, true);
    const auto nominal = test::tool_matrix(machine, wanted, false);
    for (std::size_t k = 0; k < 3; ++k)
      worst = std::max(worst, static_cast<double>(std::abs(reached[k][3] - nominal[k][3])));
  }
  EXPECT_LT(worst, 1e-12);
}

// The corrected command is beyond the end of the table of EXX.
TEST(Compensating, NamesTablesThatEndBeforeTheCommand) {
  auto m = by_hand(true);
  m.frames[0].error[0] = {{0, 0.04}, {0, 4e-6}, {}, {}, {}};
  const auto at = [&](double x_m) {
    return compensating_command(m, {x_m, 0, 0, 0, 0, 0}, MachineApproach::mean).value().beyond;
  };
  EXPECT_TRUE(at(0.03).empty());
  EXPECT_EQ(at(0.05), std::vector<std::string>{"EXX"});
}

TEST(Compensating, ReportsTheResidualOfTwoAxes) {
  auto m = by_hand(true);
  m.frames[0].error[1].forward = {3e-6};  // EYX; the machine has no Y to correct it
  m.frames[0].error[0].forward = {2e-6};
  const auto c = compensating_command(m, {0.05, 0, 0, 0, 0, 0}, MachineApproach::mean);
  ASSERT_TRUE(c);
  EXPECT_NEAR(c->residual_m[0], 0, 1e-15);
  EXPECT_NEAR(c->residual_m[1], -3e-6, 1e-15);
  EXPECT_NEAR(c->command[0] - 0.05, -2e-6, 1e-12);  // the table moved 2 µm too far
  m.frames.clear();
  EXPECT_FALSE(compensating_command(m, {}, MachineApproach::mean));
}

// Shifts and rotations have the same weight in the bound for all three axes.
TEST(MachineModel, BoundTreatsAllAxesEqually) {
  const auto bound = [](std::size_t shift, std::size_t turn) {
    auto m = by_hand(true);
    m.frames[0].error[shift].forward = {3e-6};
    m.frames[0].error[3 + turn].forward = {2e-4};
    const Command at = {0.05, 0, 0, 0, 0, 0};
    return linear_bound(m, at, values_at(m, at, MachineApproach::mean));
  };
  const LinearBound first = bound(0, 0);
  EXPECT_NEAR(first.angle_rad, 4e-8 * (1 + 8e-4), 1e-15);
  EXPECT_GT(first.place_m, 2 * 2e-4 * 3e-6);
  for (const std::size_t k : {1u, 2u}) {
    EXPECT_EQ(bound(k, 0).place_m, first.place_m);
    EXPECT_EQ(bound(0, k).place_m, first.place_m);
    EXPECT_EQ(bound(0, k).angle_rad, first.angle_rad);
  }
}

}  // namespace
}  // namespace mdof::algo
