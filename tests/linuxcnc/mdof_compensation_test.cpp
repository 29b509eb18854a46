// The mathematics of LinuxCNC's realtime component, tested without LinuxCNC. Two results are
// known:
// - A function that is linear in each of X, Y and Z equals its own interpolation on any grid.
// - The time for a distance with limited velocity and acceleration is calculated by hand.
#include "tools/linuxcnc/mdof_compensation.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace {

constexpr double kPeriod = 1e-3;  // s
constexpr mdof_limits kLimits{0.05, 1, 50, 0.1};

struct Vector {
  double v[3];
};

struct Table {
  mdof_table table{};
  std::vector<double> correction;

  Table(const std::vector<std::vector<double>>& grid, double (*at)(int, double, double, double)) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      table.n[axis] = static_cast<int>(grid[axis].size());
      std::copy(grid[axis].begin(), grid[axis].end(), table.coordinate[axis]);
    }
    for (const double z : grid[2])
      for (const double y : grid[1])
        for (const double x : grid[0])
          for (int k = 0; k < 3; ++k) correction.push_back(at(k, x, y, z));
    table.correction = correction.data();
    table.nodes = static_cast<long>(correction.size() / 3);
  }
};

double trilinear(int k, double x, double y, double z) {
  return 1 + k + (2 - k) * x - 3 * y + .5 * z + .25 * x * y - .125 * y * z + .0625 * x * z +
         .03125 * x * y * z;
}

const std::vector<std::vector<double>> kGrid{{-1, 0, 2.5, 7}, {0, 1, 4}, {-3, -2, 0, .5, 6}};

TEST(InterpolationTest, ReproducesFunctionsLinearInEachAxis) {
  const Table t(kGrid, trilinear);
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> x(-1, 7), y(0, 4), z(-3, 6);
  for (int i = 0; i < 10000; ++i) {
    const double at[3] = {x(random), y(random), z(random)};
    double found[3];
    EXPECT_TRUE(mdof_table_at(&t.table, at, found));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(found[k], trilinear(k, at[0], at[1], at[2]), 1e-13 * 100);
  }
}

TEST(InterpolationTest, OutsideTheGridTheValueAtItsEndApplies) {
  const Table t(kGrid, trilinear);
  for (const auto& [at, end] : {std::pair{Vector{-9, 2, 1}, Vector{-1, 2, 1}},
                                {{9, 2, 1}, {7, 2, 1}},
                                {{3, -1, 99}, {3, 0, 6}},
                                {{3, 5, -4}, {3, 4, -3}}}) {
    double found[3];
    EXPECT_FALSE(mdof_table_at(&t.table, at.v, found));
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(found[k], trilinear(k, end.v[0], end.v[1], end.v[2]), 1e-12);
  }
}

TEST(InterpolationTest, AnAxisWithOneCoordinateIsFixed) {
  const Table t({kGrid[0], kGrid[1], {2}}, trilinear);
  for (const double z : {2.0, 77.0}) {
    const double at[3] = {1, 1, z};
    double found[3];
    EXPECT_EQ(mdof_table_at(&t.table, at, found), z == 2);  // at z = 77 the table has no value
    EXPECT_NEAR(found[1], trilinear(1, 1, 1, 2), 1e-13);
  }
}

// Result of a run until the offset is `end`. step: largest change of the offset in one period.
// change: largest change of its velocity in one period. largest: largest offset. In machine units
// (mm) and s.
struct Ran {
  int periods = 0;
  double step = 0, change = 0, largest = 0;
};

Ran run_to(mdof_offset& offset, double end) {
  Ran ran;
  while (std::abs(offset.value - end) > 1e-12 && ran.periods < 100000) {
    const mdof_offset last = offset;
    mdof_follow(&offset, end, end, &kLimits, kPeriod);
    ran.step = std::max(ran.step, std::abs(offset.value - last.value));
    ran.change = std::max(ran.change, std::abs(offset.velocity - last.velocity));
    ran.largest = std::max(ran.largest, offset.value);
    ++ran.periods;
  }
  return ran;
}

TEST(FollowTest, AChangeOfTableFadesWithoutStepOrOvershoot) {
  mdof_offset offset{0, 0};
  const Ran ran = run_to(offset, 0.1);
  EXPECT_NEAR(ran.periods, 0.1 / kLimits.fade_velocity / kPeriod,
              3);  // 2 s: the full velocity is reached immediately
  EXPECT_LE(ran.step, kLimits.fade_velocity * kPeriod * (1 + 1e-9));  // 0.05 um per period of 1 ms
  EXPECT_LE(ran.change, kLimits.max_acceleration * kPeriod * (1 + 1e-9));
  EXPECT_LE(ran.largest, 0.1);
}

TEST(FollowTest, BrakesInTimeWithLowAcceleration) {
  mdof_limits limits = kLimits;
  limits.max_acceleration = 0.1;
  mdof_offset offset{0, 0};
  double largest = 0, change = 0;
  int periods = 0;
  for (; std::abs(offset.value - 0.1) > 1e-12 && periods < 10000; ++periods) {
    const double last = offset.velocity;
    mdof_follow(&offset, 0.1, 0.1, &limits, kPeriod);
    largest = std::max(largest, offset.value);
    change = std::max(change, std::abs(offset.velocity - last));
  }
  // Time s/v + v/a for the distance s, the velocity v and the acceleration a.
  EXPECT_NEAR(periods, (0.1 / 0.05 + 0.05 / 0.1) / kPeriod, 5);
  EXPECT_LE(largest, 0.1 + 1e-12);
  EXPECT_LE(change, limits.max_acceleration * kPeriod * (1 + 1e-9));
}

TEST(FollowTest, FollowsTheTableWithoutLag) {
  mdof_offset offset{0, 0};
  double off = 0;
  // The axis moves at 100 mm/s, and the table changes by 0.5 um/mm.
  for (int i = 0; i < 2000; ++i) {
    const double before = 5e-5 * i, now = 5e-5 * (i + 1);
    mdof_follow(&offset, before, now, &kLimits, kPeriod);
    if (now <= 0.1) off = std::max(off, std::abs(offset.value - now));
  }
  EXPECT_LE(off, 1e-12);
}

TEST(FollowTest, AChangeDuringMotionFadesToTheNewTable) {
  const auto table = [](double x) { return 0.05 * std::sin(x / 100); };
  mdof_offset offset{table(0), 0.05 / 100 * 100};
  double step = 0, beyond = 0, last_off = 2 * offset.value;
  for (int i = 0; i < 5000; ++i) {  // after 1000 periods the table changes by 0.08 mm
    const double x = 0.1 * i;
    if (i == 1000) last_off = offset.value - -table(x);
    const double sign = i < 1000 ? 1 : -1;
    const double last = offset.value, asked = std::abs(table(x + 0.1) - table(x));
    mdof_follow(&offset, sign * table(x), sign * table(x + 0.1), &kLimits, kPeriod);
    beyond = std::max(
        beyond, std::abs(offset.value - last) - std::max(kLimits.fade_velocity * kPeriod, asked));
    const double off = offset.value - sign * table(x + 0.1);
    if (i >= 1000) step = std::max(step, std::abs(off - last_off));
    last_off = off;
  }
  EXPECT_LE(std::abs(last_off), 1e-12);
  EXPECT_LE(step, 0.1 * kPeriod * (1 + 1e-9));  // in both directions
  EXPECT_LE(beyond, 1e-12);
}

TEST(FollowTest, TheLimitsHoldForAnyInput) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int scene = 0; scene < 300; ++scene) {
    mdof_offset offset{0, 0};
    const mdof_limits limits{0.05, 0.2, 5 + 50 * std::abs(any(random)), 0.1};
    double at = 0, slope = 0;
    for (int i = 0; i < 3000; ++i) {
      if (i % 500 == 0) slope = 0.3 * any(random);
      // The table changes at every 700th period.
      const double before = i % 700 == 0 ? 0.3 * any(random) : at;
      at = before + slope * kPeriod;
      const mdof_offset last = offset;
      mdof_follow(&offset, before, at, &limits, kPeriod);
      ASSERT_LE(std::abs(offset.value), limits.max_offset);
      ASSERT_LE(std::abs(offset.velocity), limits.max_velocity);
      ASSERT_LE(std::abs(offset.velocity - last.velocity),
                limits.max_acceleration * kPeriod * (1 + 1e-9));
      ASSERT_LE(std::abs(offset.value - last.value), limits.max_velocity * kPeriod * (1 + 1e-9));
    }
    EXPECT_LT(run_to(offset, 0).periods, 10000) << scene;
  }
}

TEST(FollowTest, InvalidLimitsKeepTheOffsetUnchanged) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  for (double mdof_limits::*limit : {&mdof_limits::fade_velocity, &mdof_limits::max_velocity,
                                     &mdof_limits::max_acceleration, &mdof_limits::max_offset})
    for (const double x : {0.0, -1.0, nan, infinite}) {
      mdof_limits limits = kLimits;
      limits.*limit = x;
      mdof_offset offset{0.05, 0.01};
      for (int i = 0; i < 1000; ++i) {
        const double last = offset.value;
        mdof_follow(&offset, 0.05 - 1e-5 * i, 0.05 - 1e-5 * (i + 1), &limits, kPeriod);
        ASSERT_TRUE(std::isfinite(offset.value));
        ASSERT_LE(std::abs(offset.value), 0.051);
        if (x != infinite) {
          ASSERT_LE(std::abs(offset.value - last), kLimits.max_velocity * kPeriod * (1 + 1e-9));
        }
      }
    }
}

TEST(FollowTest, AnOffsetBeyondANewLimitFadesToIt) {
  mdof_limits limits = kLimits;
  limits.max_offset = 0.01;
  mdof_offset offset{0.1, 0};
  for (int i = 0; i < 3000; ++i) {
    const double last = offset.value;
    EXPECT_TRUE(mdof_follow(&offset, 0.1, 0.1, &limits, kPeriod));
    ASSERT_LE(std::abs(offset.value - last), limits.fade_velocity * kPeriod * (1 + 1e-9));
  }
  EXPECT_NEAR(offset.value, 0.01, 1e-12);
}

class ReceiverTest : public ::testing::Test {
 protected:
  ReceiverTest() : correction_(3 * 8) {
    table_.correction = correction_.data();
    receiver_.table = &table_;
    receiver_.most_nodes = 8;
  }

  mdof_received send(mdof_record_kind kind, double a = 0, double b = 0, double c = 0,
                     unsigned session = 5) {
    const double values[3] = {a, b, c};
    return mdof_receive(&receiver_, session << 4 | kind, values, 0.1);
  }

  void send_grid() {
    EXPECT_EQ(send(MDOF_BEGIN, 12, 1), MDOF_GOES_ON);
    EXPECT_EQ(send(MDOF_SIZE, 2, 3, 1), MDOF_GOES_ON);
    for (const double x : {0, 10, -5, 0, 5, 3})
      EXPECT_EQ(send(MDOF_COORDINATE, x), MDOF_GOES_ON) << x;
  }

  std::vector<double> correction_;
  mdof_table table_{};
  mdof_receiver receiver_{};
};

TEST_F(ReceiverTest, AcceptsACompleteTable) {
  send_grid();
  for (int i = 0; i < 6; ++i) EXPECT_EQ(send(MDOF_NODE, .01 * i, -.015 * i, 0), MDOF_GOES_ON);
  EXPECT_EQ(send(MDOF_END), MDOF_COMPLETE);
  EXPECT_EQ(table_.generation_number, 12);
  EXPECT_TRUE(table_.is_simulated);
  EXPECT_EQ(table_.nodes, 6);
  EXPECT_DOUBLE_EQ(table_.largest, .075);
  const double at[3] = {10, 2.5, 3};
  double found[3];
  EXPECT_TRUE(mdof_table_at(&table_, at, found));
  EXPECT_DOUBLE_EQ(found[0], .04);  // the mean of the nodes 3 and 5
  EXPECT_DOUBLE_EQ(found[1], -.06);
}

TEST_F(ReceiverTest, RejectsAnIncompleteTable) {
  send_grid();
  EXPECT_EQ(send(MDOF_NODE), MDOF_GOES_ON);
  EXPECT_EQ(send(MDOF_END), MDOF_OUT_OF_ORDER);
  EXPECT_EQ(send(MDOF_NODE), MDOF_GOES_ON);  // ignored, because the table was rejected
  EXPECT_EQ(send(MDOF_END), MDOF_GOES_ON);
}

TEST_F(ReceiverTest, ANewLoaderRestartsAndItsPredecessorIsIgnored) {
  send_grid();
  send(MDOF_NODE, .09);
  EXPECT_EQ(send(MDOF_BEGIN, 13, 0, 0, 6), MDOF_GOES_ON);
  EXPECT_EQ(send(MDOF_NODE, .01), MDOF_GOES_ON);  // this message is from the old session 5
  EXPECT_EQ(send(MDOF_SIZE, 1, 1, 1, 6), MDOF_GOES_ON);
  for (int i = 0; i < 3; ++i) EXPECT_EQ(send(MDOF_COORDINATE, i, 0, 0, 6), MDOF_GOES_ON);
  EXPECT_EQ(send(MDOF_NODE, .02, 0, 0, 6), MDOF_GOES_ON);
  EXPECT_EQ(send(MDOF_END, 0, 0, 0, 6), MDOF_COMPLETE);
  EXPECT_DOUBLE_EQ(table_.largest, .02);
}

TEST_F(ReceiverTest, RejectsInvalidTables) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  send(MDOF_BEGIN);
  EXPECT_EQ(send(MDOF_NODE), MDOF_OUT_OF_ORDER);  // a node before the grid
  send(MDOF_BEGIN);
  EXPECT_EQ(send(MDOF_SIZE, 3, 3, 1), MDOF_TOO_LARGE);
  send(MDOF_BEGIN);
  EXPECT_EQ(send(MDOF_SIZE, 1e9, 1, 1), MDOF_TOO_LARGE);
  send(MDOF_BEGIN);
  EXPECT_EQ(send(MDOF_SIZE, nan, 1, 1), MDOF_TOO_LARGE);
  send(MDOF_BEGIN);
  EXPECT_EQ(send(MDOF_SIZE, 0, 1, 1), MDOF_TOO_LARGE);
  send(MDOF_BEGIN);
  send(MDOF_SIZE, 2, 1, 1);
  send(MDOF_COORDINATE, 1);
  EXPECT_EQ(send(MDOF_COORDINATE, 1), MDOF_BAD_NUMBER);
  send_grid();
  EXPECT_EQ(send(MDOF_NODE, 0, nan, 0), MDOF_BAD_NUMBER);
  send_grid();
  EXPECT_EQ(send(MDOF_NODE, 0, 0, -.1001), MDOF_BEYOND_LIMIT);
  send_grid();
  for (int i = 0; i < 6; ++i) send(MDOF_NODE);
  EXPECT_EQ(send(MDOF_NODE), MDOF_OUT_OF_ORDER);  // one node too many
}

}  // namespace
