// Error separation of simulated machines and targets. Shapes that the set-ups determine must be
// found. Other shapes must be named and excluded from the results.
#include "algo/separation/separate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <set>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

using Column = std::vector<double>;
using Curve = std::function<double(double)>;

constexpr double kMm = 1e-3, kUm = 1e-6, kNm = 1e-9;

double wave(double x, double period_mm, double phase) {
  return std::sin(2 * std::numbers::pi * (x / (period_mm * kMm) + phase));
}
// Errors of machine (about 3 µm) and target (about 1 µm): parabolas and waves of different periods.
double machine_at(double x) {
  return kUm * (1.1 * wave(x, 47, 0.1) + 0.4 * wave(x, 17, 0.7) + 900 * x * x);
}
double height_at(double c) {
  return kUm * (0.3 * wave(c, 38, 0.3) + 0.1 * wave(c, 13, 0.6) - 300 * c * c);
}

// Position of the measured material in the coordinate of the target. It is calculated by moving the
// bodies and not by the formula of set_up.h.
struct TargetPose {
  bool upside_down = false, end_for_end = false;
  double shift_m = 0;
};
double target_coordinate(double in_C, const TargetPose& target_pose) {
  const double from_zero = in_C - target_pose.shift_m;  // in the direction + of the motion
  return target_pose.end_for_end ? -from_zero : from_zero;
}

struct World {
  Sides sides;
  double probe_at_m = 0;
  Column x_m;
  double noise_m = 0;
  std::uint64_t seed = 1;
};

double normal(std::uint64_t seed, int number, std::size_t i) {
  const auto words =
      philox({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(number), 0, 0}, seed);
  return gaussian(uniform(words[0], words[1]));
}

// Simulated reading: the displacement of the surface in the direction +, as an error of the moving
// body.
SetUp measured(const World& world, const TargetPose& target_pose, int number) {
  SetUp s;
  s.turn = {target_pose.upside_down ? -1.0 : 1.0, target_pose.end_for_end};
  s.shift_m = target_pose.shift_m;
  for (const double x : world.x_m) {
    const double target_went = world.sides.fixture_moves != world.sides.against_encoder ? -x : x;
    const double bump = (target_pose.upside_down ? -1 : 1) *
                        height_at(target_coordinate(world.probe_at_m - target_went, target_pose));
    const double own_error = machine_at(x);
    const double of_target = world.sides.fixture_moves ? -own_error : own_error;
    const double displacement = of_target + bump + number * 5e-6 + number * 30e-6 * x / 0.06;
    s.position_m.push_back(x);
    s.error_m.push_back((world.sides.fixture_moves ? -displacement : displacement) +
                        world.noise_m * normal(world.seed, number, s.error_m.size()));
    if (world.noise_m > 0) s.u_m.push_back(world.noise_m);
  }
  return s;
}

SeparationRequest request_of(const World& world, const std::vector<TargetPose>& target_pose) {
  SeparationRequest request;
  request.at = {world.sides, world.probe_at_m};
  for (const TargetPose& l : target_pose)
    request.set_ups.push_back(measured(world, l, static_cast<int>(request.set_ups.size()) + 1));
  return request;
}

Column steps(int n, double step_m, double from_m = 0) {
  Column x;
  for (int i = 0; i < n; ++i) x.push_back(from_m + i * step_m);
  return x;
}

// Removes shapes from a column by least squares. Each shape is made orthogonal to those before it.
Column without(Column y, std::vector<Column> shapes) {
  std::vector<Column> square;
  const auto subtract_projection = [](Column& of, const Column& shape) {
    double dot = 0, norm = 0;
    for (std::size_t i = 0; i < of.size(); ++i) {
      dot += of[i] * shape[i];
      norm += shape[i] * shape[i];
    }
    for (std::size_t i = 0; i < of.size(); ++i) of[i] -= dot / norm * shape[i];
  };
  for (Column shape : shapes) {
    for (int twice = 0; twice < 2; ++twice)
      for (const Column& before : square) subtract_projection(shape, before);
    square.push_back(shape);
    subtract_projection(y, shape);
  }
  return y;
}

Column of(const Column& x, const Curve& curve) {
  Column y;
  for (const double v : x) y.push_back(curve(v));
  return y;
}
std::vector<Column> line(const Column& x) {
  return {Column(x.size(), 1.0), x};
}

double worst(const Column& a, const Column& b) {
  EXPECT_EQ(a.size(), b.size());
  double most = 0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, std::abs(a[i] - b[i]));
  return most;
}

std::set<std::string> names(const DeterminedSeries& series) {
  std::set<std::string> found;
  for (const UndeterminedShape& shape : series.unseen) found.insert(shape.name);
  return found;
}

TEST(Separation, ReversalSeparatesBothExceptForALine) {
  for (const bool fixture : {false, true}) {
    for (const bool against : {false, true}) {
      const World world{{fixture, against}, 7 * kMm, {0, 4e-3, 11e-3, 19e-3, 33e-3, 48e-3, 60e-3}};
      const auto request = request_of(world, {{}, {true, false, 0}});
      const auto found = separate(request);
      ASSERT_TRUE(found) << found.error().message;
      EXPECT_LT(worst(found->machine.seen_m, without(of(world.x_m, machine_at), line(world.x_m))),
                1e-15);
      const Column& c = found->target.place_m;
      EXPECT_NEAR(c.front(), fixture == against ? -53 * kMm : 7 * kMm, 1e-15);
      EXPECT_LT(worst(found->target.seen_m, without(of(c, height_at), line(c))), 1e-15);
      // By the textbook, the machine error is half of the sum; its line is removed.
      Column half;
      for (std::size_t i = 0; i < world.x_m.size(); ++i)
        half.push_back((request.set_ups[0].error_m[i] + request.set_ups[1].error_m[i]) / 2);
      EXPECT_LT(worst(found->machine.seen_m, without(half, line(world.x_m))), 1e-15);
      EXPECT_EQ(names(found->target), (std::set<std::string>{"offset", "slope"}));
      EXPECT_EQ(names(found->machine), names(found->target));
      EXPECT_TRUE(found->target.whole());
      EXPECT_EQ(found->rank, 14u);
      EXPECT_EQ(found->freedom(), 0u);
      EXPECT_TRUE(std::isnan(found->target.u_m[0]));
    }
  }
}

TEST(Separation, OneShiftHidesParabolaAndPeriods) {
  for (const bool against : {false, true}) {
    const World world{{false, against}, 0, steps(25, 2.5 * kMm)};
    const auto found = separate(request_of(world, {{}, {false, false, 10 * kMm}}));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_EQ(names(found->target), (std::set<std::string>{"offset", "slope", "parabola",
                                                           "period 10 mm", "period 5 mm"}));
    EXPECT_EQ(names(found->machine), names(found->target));
    EXPECT_FALSE(found->target.whole());
    for (const auto& [series, truth] : {std::pair{found->target, Curve(height_at)},
                                        std::pair{found->machine, Curve(machine_at)}}) {
      const Column& c = series.place_m;
      auto hidden = line(c);
      hidden.push_back(of(c, [](double x) { return x * x; }));
      hidden.push_back(of(c, [&](double x) { return wave(x - c[0], 10, 0); }));
      hidden.push_back(of(c, [&](double x) { return wave(x - c[0], 10, 0.25); }));
      hidden.push_back(of(c, [&](double x) { return wave(x - c[0], 5, 0.25); }));
      EXPECT_LT(worst(series.seen_m, without(of(c, truth), hidden)), 1e-13);
    }
    EXPECT_EQ(found->target.place_m.size(), 29u);
    EXPECT_EQ(found->unknowns - found->rank, 4u + 4u);
  }
}

TEST(Separation, ShiftsWithoutCommonDivisorHideOnlyTheParabola) {
  const World world{{}, 0, steps(25, 2.5 * kMm)};
  const auto found =
      separate(request_of(world, {{}, {false, false, 10 * kMm}, {false, false, -7.5 * kMm}}));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(names(found->target), (std::set<std::string>{"offset", "slope", "parabola"}));
}

TEST(Separation, ShiftAndTurnSeparateAllExceptALine) {
  const World world{{}, 3 * kMm, steps(25, 2.5 * kMm)};
  const auto found = separate(request_of(
      world, {{}, {false, false, 10 * kMm}, {false, false, -5 * kMm}, {true, false, 0}}));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_TRUE(found->target.whole());
  const Column& c = found->target.place_m;
  EXPECT_LT(worst(found->target.seen_m, without(of(c, height_at), line(c))), 1e-13);
  EXPECT_GT(found->freedom(), 20u);
  EXPECT_LT(found->residual_m, 1e-15);
}

// A shape whose sign changes over the shift equals a shape of the machine after the turn.
TEST(Separation, TurnWithShiftHidesTwiceTheShift) {
  const World world{{}, 0, steps(25, 2.5 * kMm)};
  auto found = separate(request_of(world, {{}, {true, false, 10 * kMm}}));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(names(found->target),
            (std::set<std::string>{"offset", "slope", "period 20 mm", "period 6.666667 mm"}));
  found = separate(request_of(
      world, {{}, {false, false, 10 * kMm}, {false, false, -5 * kMm}, {true, false, 2.5 * kMm}}));
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_EQ(names(found->target), (std::set<std::string>{"offset", "slope", "period 5 mm"}));
}

// After a turn about the normal, shapes that are symmetric about the middle are not determined.
// After a turn about the third axis, antisymmetric shapes are not determined.
TEST(Separation, EndForEndTurnSeesHalfOfTheShapes) {
  const World world{{}, 0, steps(13, 5 * kMm)};
  for (const bool upside_down : {false, true}) {
    const auto found = separate(request_of(world, {{}, {upside_down, true, -60 * kMm}}));
    ASSERT_TRUE(found) << found.error().message;
    const Column& c = found->target.place_m;
    ASSERT_EQ(c.size(), 13u);
    Column half = of(c, height_at);
    for (std::size_t i = 0; i < 13; ++i)
      half[i] = (height_at(c[i]) + (upside_down ? 1 : -1) * height_at(c[12 - i])) / 2;
    EXPECT_LT(worst(found->target.seen_m, without(half, line(c))), 1e-13);
    std::set<std::string> expected{"offset", "slope"};
    if (!upside_down) expected.insert({"parabola", "5 more shapes symmetric about -30 mm"});
    if (upside_down) expected.insert("5 more shapes antisymmetric about -30 mm");
    EXPECT_EQ(names(found->target), expected);
  }
}

TEST(Separation, UncertaintyMatchesTheNoise) {
  World world{{}, 0, steps(13, 5 * kMm), 5 * kNm};
  const std::vector<TargetPose> target_pose = {{}, {true, false, 0}, {false, false, 5 * kMm}};
  constexpr int kTrials = 2000;
  Column sum(14), square(14), u;
  for (int trial = 0; trial < kTrials; ++trial) {
    world.seed = static_cast<std::uint64_t>(trial) + 1;
    const auto found = separate(request_of(world, target_pose));
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_TRUE(found->notices.empty());
    u = found->target.u_m;
    for (std::size_t i = 0; i < u.size(); ++i) {
      sum[i] += found->target.seen_m[i] / kTrials;
      square[i] += found->target.seen_m[i] * found->target.seen_m[i] / kTrials;
    }
  }
  for (std::size_t i = 0; i < u.size(); ++i)
    EXPECT_NEAR(std::sqrt(square[i] - sum[i] * sum[i]) / u[i], 1, 0.06) << i;
  // Reversal alone: half differences have u/sqrt(2); the line is not contained in the result.
  const auto reversal = separate(request_of(world, {{}, {true, false, 0}}));
  double trace = 0;
  for (const double v : reversal->target.u_m) trace += v * v / (5 * kNm * 5 * kNm);
  EXPECT_NEAR(trace, (13 - 2) / 2.0, 1e-9);
}

// The third set-up equals the first with ten times the uncertainty, so its weight is 1/100.
TEST(Separation, ReadingsAreWeightedByTheirUncertainty) {
  const World world{{}, 0, steps(7, 10 * kMm), 1 * kNm};
  auto request = request_of(world, {{}, {true, false, 0}, {}});
  for (double& u : request.set_ups[2].u_m) u *= 10;
  const auto found = separate(request);
  ASSERT_TRUE(found) << found.error().message;
  double trace = 0;
  for (const double v : found->target.u_m) trace += v * v;
  EXPECT_NEAR(trace / (kNm * kNm), (7 - 2) * (1 / (1 + 0.01) + 1) / 4, 1e-9);
}

TEST(Separation, UsesTheScatterWithoutUncertainty) {
  constexpr int kTrials = 400;
  double square = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    const World world{{}, 0, steps(9, 5 * kMm), 5 * kNm, static_cast<std::uint64_t>(trial) + 1};
    auto request = request_of(world, {{}, {true, false, 0}, {false, false, 5 * kMm}});
    const auto with = separate(request);
    for (auto& s : request.set_ups) s.u_m.clear();
    const auto by_scatter = separate(request);
    ASSERT_TRUE(with && by_scatter);
    ASSERT_EQ(by_scatter->freedom(), 6u);
    EXPECT_NE(by_scatter->u_reason.find("scatter"), std::string::npos);
    square += std::pow(by_scatter->target.u_m[4] / with->target.u_m[4], 2) / kTrials;
  }
  EXPECT_NEAR(square, 1, 0.09);  // standard deviation of the mean: sqrt(2/6/400) = 0.03
}

TEST(Separation, ReportsAWrongShift) {
  const World world{{}, 0, steps(25, 2.5 * kMm), 5 * kNm};
  auto request = request_of(world, {{}, {true, false, 0}, {false, false, 5 * kMm}});
  EXPECT_TRUE(separate(request)->notices.empty());
  request.set_ups[2].shift_m = -5 * kMm;
  const auto wrong = separate(request);
  ASSERT_TRUE(wrong);
  ASSERT_EQ(wrong->notices.size(), 1u);
  EXPECT_EQ(wrong->notices[0].code, NoticeCode::set_ups_contradict);
  EXPECT_EQ(wrong->notices[0].severity, Severity::invalid);
}

TEST(Separation, RejectsImpossibleSetUps) {
  const World world{{}, 0, steps(7, 10 * kMm)};
  const auto says = [&](const SeparationRequest& request, const std::string& words) {
    const auto found = separate(request);
    ASSERT_FALSE(found) << words;
    EXPECT_EQ(found.error().code, ErrorCode::bad_input);
    EXPECT_NE(found.error().message.find(words), std::string::npos) << found.error().message;
  };
  says(request_of(world, {{}}), "one set-up");
  says(request_of(world, {{}, {}}), "has the same position and orientation");
  says(request_of(world, {{}, {false, false, 4 * kMm}}), "a multiple of the step of 10 mm");
  says(request_of(world, {{}, {false, false, 70 * kMm}}),
       "no two set-ups measure the same point of the target");
  says(request_of({{}, 0, {0, 10e-3, 21e-3, 30e-3}}, {{}, {false, false, 10 * kMm}}),
       "not equally spaced");
  auto request = request_of(world, {{}, {true, false, 0}});
  for (double& x : request.set_ups[1].position_m) x += 1 * kMm;
  says(request, "no two set-ups measure the same point of the machine");
  request = request_of(world, {{}, {true, false, 0}});
  request.set_ups[1].error_m[3] = std::nan("");
  says(request, "set-up 2: a value is not a finite number");
  request = request_of(world, {{}, {true, false, 0}});
  request.set_ups[0].u_m.assign(7, -1e-9);
  says(request, "negative");
  request.set_ups[0] = {{0, 1}, {0, 1}, {}, {}, {}, 0};
  says(request, "2 readings");
}

// By hand: in a reversal the machine error is half of the sum. A common gain error of 1 % is 1 % of
// the result. Separate gain errors of 1 % are 1 % of each half, and their squares add.
TEST(Separate, UContainsDeclaredShifts) {
  const auto found = [](const std::string& common, double gain) {
    SeparationRequest request;
    request.u_is_noise = true;
    for (int k = 0; k < 2; ++k) {
      auto& set_up = request.set_ups.emplace_back();
      for (int i = 0; i < 7; ++i) {
        const double x = 0.005 * i;
        set_up.position_m.push_back(x);
        set_up.error_m.push_back(kUm * (std::sin(300 * x) + (k == 0 ? 1 : -1) * std::cos(200 * x)));
        set_up.u_m.push_back(1e-12);
      }
      set_up.turn.height_sign = k == 0 ? 1 : -1;
      if (gain == 0) continue;
      DeclaredShift& shift = set_up.declared.emplace_back(DeclaredShift{common, {}});
      for (const double e : set_up.error_m) shift.shift_m.push_back(gain * e);
    }
    return separate(request).value();
  };
  const Separation one = found("gain", 0.01), none = found("", 0);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(one.machine.u_m[i], 0.01 * std::abs(one.machine.seen_m[i]), 2e-12);
    EXPECT_NEAR(one.target.u_m[i], 0.01 * std::abs(one.target.seen_m[i]), 2e-12);
    EXPECT_LT(none.machine.u_m[i], 2e-12);
  }
  // Each set-up has its own gain. Places on the target decrease if positions increase.
  const Separation own = found("", 0.01);
  for (std::size_t i = 0; i < 7; ++i) {
    const double first = one.machine.seen_m[i] + one.target.seen_m[6 - i];
    const double second = one.machine.seen_m[i] - one.target.seen_m[6 - i];
    EXPECT_NEAR(own.machine.u_m[i], 0.005 * std::hypot(first, second), 2e-12);
  }
  EXPECT_FALSE(one.noise_only);
  EXPECT_TRUE(none.noise_only);
  EXPECT_NE(none.u_reason.find("repeatability only"), std::string::npos);
}

// Four set-ups with noise of 2 nm. The probes have separate scale errors of about 1 %.
TEST(Separate, DeclaredShiftsDoNotContradict) {
  const auto accused = [](double declared_scale) {
    int n = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      const World world{{}, 0, steps(9, 5e-3), 2e-9, seed};
      SeparationRequest request =
          request_of(world, {{}, {true, false, 0}, {false, false, 10e-3}, {true, false, 5e-3}});
      for (std::size_t k = 0; k < request.set_ups.size(); ++k) {
        auto& readings = request.set_ups[k];
        DeclaredShift shift;
        const double gain = 0.01 * normal(seed, 100 + static_cast<int>(k), 0);
        for (double& error_m : readings.error_m) {
          error_m *= 1 + gain;
          shift.shift_m.push_back(declared_scale * error_m);
        }
        if (declared_scale > 0) readings.declared.push_back(shift);
      }
      n += !separate(request).value().notices.empty();
    }
    return n;
  };
  EXPECT_EQ(accused(0.01), 0);
  EXPECT_GT(accused(0), 75);
  EXPECT_GT(accused(0.001), 40);  // the scale errors are ten times the declared u
}

}  // namespace
}  // namespace mdof::algo
