// Compares height maps, fixtures, means, tables and the aligner with models that share no code with
// them. The models use sums of tent functions, bisection along the line of a probe, and values
// calculated by hand.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "algo/compensation/compensation.h"
#include "algo/iso230/target_means.h"
#include "algo/model/fixture.h"
#include "algo/model/rigid.h"
#include "algo/model/solver.h"
#include "algo/points/align.h"
#include "tests/algo/rigs.h"

namespace mdof::algo {
namespace {

// 1 at node k, 0 at its neighbours, linear in between, constant beyond the ends.
double tent(const std::vector<double>& nodes, std::size_t k, double x) {
  x = std::min(std::max(x, nodes.front()), nodes.back());
  if (k > 0 && x < nodes[k]) return std::max(0.0, (x - nodes[k - 1]) / (nodes[k] - nodes[k - 1]));
  if (k + 1 < nodes.size() && x > nodes[k])
    return std::max(0.0, (nodes[k + 1] - x) / (nodes[k + 1] - nodes[k]));
  return x == nodes[k] ? 1.0 : 0.0;
}

double model_height(const HeightMap& map, double first_m, double second_m) {
  double sum = 0;
  for (std::size_t i = 0; i < map.first_m.size(); ++i)
    for (std::size_t j = 0; j < map.second_m.size(); ++j)
      sum += map.height_m[i * map.second_m.size() + j] * tent(map.first_m, i, first_m) *
             tent(map.second_m, j, second_m);
  return sum;
}

// A map with uneven nodes, a different number of nodes in each direction, and slopes of about 1e-4.
HeightMap random_map(std::mt19937_64& engine) {
  std::uniform_real_distribution<> unit(0, 1);
  HeightMap map;
  for (double x = -0.03; x < 0.04; x += 0.004 + 0.006 * unit(engine)) map.first_m.push_back(x);
  for (double y = -0.02; y < 0.04; y += 0.006 + 0.009 * unit(engine)) map.second_m.push_back(y);
  for (std::size_t i = 0; i < map.first_m.size() * map.second_m.size(); ++i)
    map.height_m.push_back(2e-6 * unit(engine) - 1e-6);
  return map;
}

TEST(OutsideTruth, HeightMapEqualsSumOfTentFunctions) {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<> across(-0.05, 0.05);
  for (int round = 0; round < 20; ++round) {
    const HeightMap map = random_map(engine);
    for (int k = 0; k < 50; ++k) {
      const double x = across(engine), y = across(engine);
      EXPECT_NEAR(height_at(map, x, y), model_height(map, x, y), 1e-18);
    }
  }
}

using Vector = std::array<double, 3>;

double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// Transforms a point p from the machine frame M to the carriage frame C: Rᵀ (p - t). R = Rz Ry Rx;
// the three rotations are inverted one after the other.
Vector to_carriage(Vector p, double travel_m, const Errors5& e) {
  p = {p[0] - travel_m, p[1] - e[0], p[2] - e[1]};
  const auto turn = [&p](std::size_t a, std::size_t b, double angle) {
    const double c = std::cos(angle), s = std::sin(angle), x = p[a], y = p[b];
    p[a] = c * x + s * y;
    p[b] = -s * x + c * y;
  };
  turn(0, 1, e[4]);  // about z
  turn(2, 0, e[3]);  // about y
  turn(1, 2, e[2]);  // about x
  return p;
}

// Distance along the line of the probe to the surface, found by bisection. The surface is z = h(x,
// y) if `top`, otherwise y = side + h(x, z).
double model_reading(const FixtureProbe& probe, bool top, double travel_m, const Errors5& e) {
  const auto above = [&](double s) {
    Vector p;
    for (int k = 0; k < 3; ++k) p[static_cast<std::size_t>(k)] = probe.p_MP(k) + s * probe.u_M(k);
    const Vector c = to_carriage(p, travel_m, e);
    const double h =
        probe.flatness.empty() ? 0.0 : model_height(probe.flatness, c[0], top ? c[1] : c[2]);
    const Vector normal = {probe.n_C(0), probe.n_C(1), probe.n_C(2)};
    return dot(normal, c) - probe.plane_offset_m - h;
  };
  double low = -2e-3, high = 2e-3;
  const bool rising = above(high) > 0;
  for (int i = 0; i < 80; ++i) {
    const double middle = 0.5 * (low + high);
    (above(middle) > 0) == rising ? high = middle : low = middle;
  }
  return 0.5 * (low + high);
}

// Two probes point in the negative direction of an axis and two are oblique. Both planes have a
// random height map.
TEST(OutsideTruth, ReadingsOfARandomTargetMatchBisection) {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<> unit(-1, 1);
  Rig rig = test::rig_oblique();
  for (int round = 0; round < 20; ++round) {
    for (auto& plane : rig.planes) plane.flatness = random_map(engine);
    const Fixture fixture = make_fixture(rig).value();
    const Errors5 e = {50e-6 * unit(engine), 50e-6 * unit(engine), 1e-3 * unit(engine),
                       1e-3 * unit(engine), 1e-3 * unit(engine)};
    const double travel_m = 0.02 * unit(engine);
    const auto readings = rigid_readings(fixture, travel_m, e);
    std::vector<double> read, weights(fixture.probes.size(), 1.0);
    for (std::size_t k = 0; k < fixture.probes.size(); ++k) {
      const FixtureProbe& probe = fixture.probes[k];
      const bool top = std::abs(probe.n_C(2)) > 0.5;
      read.push_back(model_reading(probe, top, travel_m, e));
      EXPECT_NEAR(readings(static_cast<Eigen::Index>(k)), read.back(), 1e-13) << probe.id;
    }
    const AxisErrors solved = solve_rigid(fixture, travel_m, read, weights);
    ASSERT_TRUE(solved.valid);
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(solved.local[k], e[k], k < 2 ? 1e-10 : 1e-8) << k;
  }
}

// The top plane has a hill of 1 µm under probe P1 alone, so the surface at P1 is 1 µm higher (+Z).
TEST(OutsideTruth, HillGivesPositiveReading) {
  Rig rig = test::rig_oblique();
  for (auto& plane : rig.planes)
    if (plane.id == "top")
      plane.flatness = {
          {0.011, 0.012, 0.013}, {0.002, 0.003, 0.004}, {0, 0, 0, 0, 1e-6, 0, 0, 0, 0}};
  const auto readings = rigid_readings(make_fixture(rig).value(), 0, {});
  EXPECT_NEAR(readings(0), 1e-6, 1e-12);  // P1, at (12, 3)
  EXPECT_NEAR(readings(1), 0, 1e-12);
}

// Solves readings of fixtures other than the default fixture; the same bisection gives the
// readings. Probe D is not at x = 0. The exact model differs from a true rotation in second order:
// by 31 nm at 1 mrad, by 0.31 nm at 0.1 mrad.
TEST(OutsideTruth, ExactModelHoldsForOtherFixtures) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<> unit(-1, 1);
  for (int round = 0; round < 20; ++round) {
    Rig rig = test::rig_x(8 + 2 * unit(engine), 12 + 2 * unit(engine), 18 + 3 * unit(engine));
    for (auto& probe : rig.probes) {
      const bool side = probe.id == "D" || probe.id == "E";
      probe.position_m[0] += 3e-3 * unit(engine);
      probe.position_m[side ? 2 : 1] += 2e-3 * unit(engine);
    }
    const Fixture fixture = make_fixture(rig).value();
    const Solver solver = Solver::create(rig, Model::exact).value();
    const Errors5 e = {5e-6 * unit(engine), 5e-6 * unit(engine), 1e-4 * unit(engine),
                       1e-4 * unit(engine), 1e-4 * unit(engine)};
    const double travel_m = 0.02 * unit(engine);
    std::vector<double> read;
    for (std::size_t k = 0; k < 5; ++k)
      read.push_back(model_reading(fixture.probes[k], k < 3, travel_m, e));
    const AxisErrors solved = solver.solve(travel_m, read, std::vector<double>(5, 1e-9));
    ASSERT_TRUE(solved.valid) << solved.reason;
    for (std::size_t k = 0; k < 5; ++k)
      EXPECT_NEAR(solved.local[k], e[k], k < 2 ? 1e-9 : 3e-8) << k;
  }
}

MeasuredPoint point(int target, int run, int direction, double position_m, double value, double u) {
  MeasuredPoint p;
  p.target = target;
  p.run = run;
  p.point.direction = direction;
  p.point.position_m = position_m;
  p.errors.valid = true;
  for (std::size_t k = 0; k < 5; ++k) {
    p.errors.local[k] = value;
    p.errors.covariance[6 * k] = u * u;
  }
  return p;
}

// The values 1, 2 and 4 have the mean 7/3 and Σ(x - mean)² = 14/3. The standard deviation of their
// mean is √(14/3 / 2 / 3) = √(7/9).
TEST(OutsideTruth, MeanAndItsUncertaintyByHand) {
  const MovingAxis moving{Axis::x, {}};
  const auto of = [&](double u) {
    return target_means(
        moving,
        {point(1, 1, 1, 0.01, 1, u), point(1, 2, 1, 0.02, 2, u), point(1, 3, 1, 0.06, 4, u)},
        Approach::forward);
  };
  const auto quiet = of(0);
  ASSERT_EQ(quiet.size(), 1u);
  EXPECT_EQ(quiet[0].n, 3u);
  EXPECT_NEAR(quiet[0].position_m, 0.03, 1e-15);
  for (std::size_t k = 0; k < 5; ++k) {
    EXPECT_NEAR(std::abs(quiet[0].named[k]), 7.0 / 3, 1e-14);
    EXPECT_NEAR(quiet[0].u[k], std::sqrt(7.0 / 9), 1e-14);
    EXPECT_NEAR(of(3)[0].u[k], std::sqrt(3.0), 1e-14);  // each value has u = 3, the mean 3/√3
    EXPECT_NEAR(of(0.1)[0].u[k], std::sqrt(7.0 / 9), 1e-14);
  }
}

// An error curve at uneven positions. The curve is linear between its points and across a missing
// value, and constant beyond its ends. u is interpolated linearly, too. The uncertainty of the
// interpolation is added in quadrature.
TEST(OutsideTruth, TableIsLinearBetweenItsPoints) {
  CompensationTable table;
  table.position_m = {0, 1, 3, 4, 8};
  for (std::size_t k = 0; k < 5; ++k) {
    const double f = 1 + static_cast<double>(k);
    table.forward[k] = {0 * f, 1 * f, 9 * f, 16 * f, 64 * f};
    table.reverse[k] = {2 * f, kNaN, 11 * f, kNaN, 66 * f};
    table.u_forward[k] = {3, 6, 3, 12, 3};
    table.u_reverse[k] = {4, kNaN, 4, kNaN, 4};
  }
  const struct {
    double at, forward, reverse, u_forward;
  } cases[] = {{-1, 0, 2, 3},       {0, 0, 2, 3},  {0.25, 0.25, 2.75, 3.75},   {1, 1, 5, 6},
               {1.5, 3, 6.5, 5.25}, {3, 9, 11, 3}, {3.75, 14.25, 19.25, 9.75}, {5, 28, 33, 9.75},
               {8, 64, 66, 3},      {9, 64, 66, 3}};
  for (const auto& c : cases) {
    const auto forward = table_at(table, c.at, TableSide::forward);
    const auto reverse = table_at(table, c.at, TableSide::reverse);
    const auto mean = table_at(table, c.at, TableSide::mean);
    for (std::size_t k = 0; k < 5; ++k) {
      const double f = 1 + static_cast<double>(k);
      EXPECT_NEAR(forward.error[k], f * c.forward, 1e-12) << c.at;
      EXPECT_NEAR(reverse.error[k], f * c.reverse, 1e-12) << c.at;
      EXPECT_NEAR(mean.error[k], f * (c.forward + c.reverse) / 2, 1e-12) << c.at;
      EXPECT_NEAR(forward.u[k], std::hypot(c.u_forward, forward.u_interpolation[k]), 1e-12) << c.at;
      EXPECT_NEAR(reverse.u[k], std::hypot(4, reverse.u_interpolation[k]), 1e-12) << c.at;
      // Angles (k >= 2) refer to the mean of both approaches at the first target. If its variance
      // is V, then u² of each approach at the first target is V, too, and the mean of both has u =
      // 0 there and (u_f² + u_r²)/4 - V/2 + V elsewhere.
      const double V = k < 2 ? 0 : (3 * 3 + 4 * 4) / 2.0, share = std::clamp(c.at, 0.0, 1.0);
      EXPECT_NEAR(mean.u[k],
                  std::hypot(std::sqrt(c.u_forward * c.u_forward / 4 + 4 + (share - 0.5) * V),
                             mean.u_interpolation[k]),
                  1e-7)
          << c.at;
    }
  }
}

// Three devices have different, uneven time stamps. The position and the readings of each frame
// equal the linear interpolation of the samples that the test sends.
TEST(OutsideTruth, FramesOfSeveralDevicesAreInterpolated) {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<> unit(0, 1);
  struct Sent {
    std::vector<std::int64_t> time_ns;
    std::vector<double> value;
  };
  const auto device = [&](double mean_ms) {
    Sent sent;
    double t_ms = 0;
    for (int i = 0; i < 400; ++i) {
      t_ms += mean_ms * (0.2 + 1.6 * unit(engine));
      sent.time_ns.push_back(static_cast<std::int64_t>(t_ms * 1e6));
      sent.value.push_back(unit(engine));
    }
    return sent;
  };
  const std::vector<std::string> ids = {"encoder", "A", "B"};
  const std::vector<Sent> sent = {device(1.0), device(1.7), device(1.3)};
  Aligner aligner({}, {"A", "B"});
  FrameBlock out;
  for (std::size_t i = 0; i < 400; i += 8) {
    for (std::size_t d = 0; d < 3; ++d) {
      SampleBlock block;
      block.device = ids[d];
      block.channels = {{ids[d], Unit::metre}};
      const auto from = static_cast<std::ptrdiff_t>(i), to = from + 8;
      block.time_ns.assign(sent[d].time_ns.begin() + from, sent[d].time_ns.begin() + to);
      block.value = {{sent[d].value.begin() + from, sent[d].value.begin() + to}};
      ASSERT_TRUE(aligner.push(block, out));
    }
  }
  aligner.flush(out);
  ASSERT_EQ(out.size(), 400u);
  EXPECT_EQ(out.time_ns, sent[0].time_ns);
  EXPECT_EQ(out.encoder_m, sent[0].value);
  for (std::size_t d = 1; d < 3; ++d) {
    for (std::size_t i = 0; i < 400; ++i) {
      const std::int64_t t = out.time_ns[i];
      std::size_t k = 0;
      while (k < 400 && sent[d].time_ns[k] < t) ++k;
      if (k == 0 || k == 400) {
        const bool met = k == 0 && sent[d].time_ns[0] == t;
        EXPECT_TRUE(met || std::isnan(out.probe_m[d - 1][i]));
        continue;
      }
      const double share = static_cast<double>(t - sent[d].time_ns[k - 1]) /
                           static_cast<double>(sent[d].time_ns[k] - sent[d].time_ns[k - 1]);
      const double expected = (1 - share) * sent[d].value[k - 1] + share * sent[d].value[k];
      EXPECT_NEAR(out.probe_m[d - 1][i], expected, 1e-12) << ids[d] << " " << i;
    }
  }
}

}  // namespace
}  // namespace mdof::algo
