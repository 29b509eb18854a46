#include "algo/machine/geometric_tests/perpendicularity.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace mdof::algo {
namespace {

constexpr int kCircles = 2000;

// Sum of twelve uniform numbers, nearly a normal number.
double standard_normal(std::mt19937& source) {
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += static_cast<double>(source()) / 4294967296.0;
  return sum;
}

// Heights on a disc that is tilted by rotations a and b about X and Y. A wobble of the rotary table
// and form errors of the linear axes are added. `known`: the readings also contain the wobble and
// the form errors.
CircleReadings circle(double a, double b, double noise_m, std::mt19937& source, bool known) {
  CircleReadings r;
  r.radius_m = 0.1;
  const int n = 72;
  for (int i = 0; i < n; ++i) {
    const double angle = 6.283185307179586 * i / n, x = 0.1 * std::cos(angle),
                 y = 0.1 * std::sin(angle);
    const double wobble_a = 3e-6 * std::cos(2 * angle + 0.4), wobble_b = 2e-6 * std::sin(3 * angle);
    const double axes = 40e-6 * x * x - 300e-6 * x * x * x;
    r.angle_rad.push_back(angle);
    r.height_m.push_back(2e-6 + a * y - b * x + wobble_a * y - wobble_b * x + axes +
                         noise_m * standard_normal(source));
    if (!known) continue;
    r.tilt_a_rad.push_back(wobble_a);
    r.tilt_b_rad.push_back(wobble_b);
    r.axes_m.push_back(axes);
  }
  return r;
}

TEST(PerpendicularityTest, IsSeparatedFromWobbleAndAxisErrors) {
  std::mt19937 source(5);
  const auto p = perpendicularity(circle(20e-6, -7e-6, 0, source, true), 5);
  ASSERT_TRUE(p);
  EXPECT_NEAR(p->EA0C_rad, 20e-6, 1e-15);
  EXPECT_NEAR(p->EB0C_rad, -7e-6, 1e-15);
  EXPECT_NEAR(p->mean_m, 2e-6, 1e-15);
  EXPECT_TRUE(p->tilt_known && p->axes_known);
  for (std::size_t k = 1; k < 5; ++k)
    EXPECT_NEAR(std::hypot(p->harmonics[k].cosine_m, p->harmonics[k].sine_m), 0, 1e-15);
  // If the wobble is not known, its part at twice the angle appears as perpendicularity.
  const auto blind = perpendicularity(circle(20e-6, -7e-6, 0, source, false), 5);
  EXPECT_GT(std::abs(blind->EA0C_rad - 20e-6), 1e-6);
  EXPECT_FALSE(blind->tilt_known || blind->axes_known);
}

TEST(PerpendicularityTest, IntervalsCoverTheTruth) {
  std::mt19937 source(6);
  int a_covered = 0, b_covered = 0;
  for (int i = 0; i < kCircles; ++i) {
    const double a = 20e-6 * standard_normal(source), b = 20e-6 * standard_normal(source);
    const auto p = perpendicularity(circle(a, b, 0.1e-6, source, true), 5);
    a_covered += std::abs(p->EA0C_rad - a) <= p->U_rad ? 1 : 0;
    b_covered += std::abs(p->EB0C_rad - b) <= p->U_rad ? 1 : 0;
  }
  for (const int covered : {a_covered, b_covered}) {
    EXPECT_GE(covered, 0.94 * kCircles);
    EXPECT_LE(covered, 0.965 * kCircles);
  }
}

// Readings over `turns` turns. The height drifts by drift_m from the first reading to the last.
CircleReadings turning_circle(double a, double b, double noise_m, std::mt19937& source, int turns,
                              double drift_m) {
  CircleReadings all;
  for (int turn = 0; turn < turns; ++turn) {
    const CircleReadings one = circle(a, b, noise_m, source, true);
    all.radius_m = one.radius_m;
    for (std::size_t i = 0; i < one.angle_rad.size(); ++i) {
      all.angle_rad.push_back(one.angle_rad[i] + turn * 6.283185307179586);
      all.height_m.push_back(one.height_m[i]);
      all.tilt_a_rad.push_back(one.tilt_a_rad[i]);
      all.tilt_b_rad.push_back(one.tilt_b_rad[i]);
      all.axes_m.push_back(one.axes_m[i]);
    }
  }
  const auto last = static_cast<double>(all.height_m.size() - 1);
  for (std::size_t i = 0; i < all.height_m.size(); ++i)
    all.height_m[i] += drift_m * static_cast<double>(i) / last;
  return all;
}

TEST(PerpendicularityTest, RemovesADriftBetweenTurns) {
  std::mt19937 source(8);
  auto readings = turning_circle(20e-6, -7e-6, 0, source, 2, 3e-6);
  const auto p = perpendicularity(readings, 5);
  ASSERT_TRUE(p) << p.error().message;
  EXPECT_TRUE(p->drift_fitted);
  EXPECT_NEAR(p->turns, 2 - 1.0 / 72, 1e-12);
  EXPECT_NEAR(p->drift_m, 3e-6, 1e-16);
  EXPECT_NEAR(p->EA0C_rad, 20e-6, 1e-15);
  EXPECT_NEAR(p->EB0C_rad, -7e-6, 1e-15);
  // The table pauses and then turns in the opposite direction. The drift is proportional to the
  // time of the readings.
  auto paused = turning_circle(20e-6, -7e-6, 0, source, 2, 0);
  for (auto* of : {&paused.angle_rad, &paused.height_m, &paused.tilt_a_rad, &paused.tilt_b_rad,
                   &paused.axes_m})
    std::reverse(of->begin() + 72, of->end());
  for (int i = 0; i < 144; ++i) {
    paused.time_s.push_back(i + (i < 72 ? 0 : 100));
    paused.height_m[static_cast<std::size_t>(i)] += 3e-6 * paused.time_s.back() / 243;
  }
  const auto back = perpendicularity(paused, 5);
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_NEAR(back->drift_m, 3e-6, 1e-16);
  EXPECT_NEAR(back->EB0C_rad, -7e-6, 1e-15);
  paused.time_s[5] = paused.time_s[4];
  ASSERT_FALSE(perpendicularity(paused, 5));
  EXPECT_NE(perpendicularity(paused, 5).error().message.find("reading 6"), std::string::npos);
  // One turn without a repeated angle: the drift cannot be determined.
  const auto one = perpendicularity(turning_circle(20e-6, -7e-6, 0, source, 1, 3e-6), 5);
  ASSERT_TRUE(one);
  EXPECT_FALSE(one->drift_fitted);
  EXPECT_EQ(one->drift_m, 0);
  EXPECT_GT(std::abs(one->EA0C_rad - 20e-6), 5e-6);  // effect of the drift: 3e-6/π over the radius
}

// Required: the intervals of 93 to 97.5 % of 2,000 simulations contain the truth. Each simulation
// has its own drift.
TEST(PerpendicularityTest, IntervalsCoverTheTruthUnderDrift) {
  std::mt19937 source(9);
  for (const int turns : {2, 3}) {
    std::array<int, 3> covered{};  // for EA0C, EB0C, drift
    for (int i = 0; i < kCircles; ++i) {
      const double a = 20e-6 * standard_normal(source), b = 20e-6 * standard_normal(source),
                   d = 1e-6 * standard_normal(source);
      const auto p = perpendicularity(turning_circle(a, b, 0.1e-6, source, turns, d), 5);
      covered[0] += std::abs(p->EA0C_rad - a) <= p->U_rad ? 1 : 0;
      covered[1] += std::abs(p->EB0C_rad - b) <= p->U_rad ? 1 : 0;
      covered[2] += std::abs(p->drift_m - d) <= p->k * p->u_drift_m ? 1 : 0;
    }
    for (std::size_t i = 0; i < covered.size(); ++i) {
      RecordProperty("covered_" + std::to_string(turns) + std::to_string(i), covered[i]);
      EXPECT_GE(covered[i], 0.93 * kCircles) << turns << " turns, " << i;
      EXPECT_LE(covered[i], 0.975 * kCircles) << turns << " turns, " << i;
    }
  }
}

// Without times the order of the readings is their time. One change of the direction is possible,
// and an angle that scatters by less than 5°.
TEST(PerpendicularityTest, RefusesReadingsInAnotherOrder) {
  std::mt19937 source(10);
  const auto says = [](const CircleReadings& r, const std::string& words) {
    const auto p = perpendicularity(r, 5);
    ASSERT_FALSE(p) << words;
    EXPECT_NE(p.error().message.find(words), std::string::npos) << p.error().message;
    EXPECT_NE(p.error().message.find("time_s"), std::string::npos) << p.error().message;
  };
  const auto arranged = [](const CircleReadings& r, const std::vector<std::size_t>& order) {
    CircleReadings out = r;
    for (std::size_t i = 0; i < order.size(); ++i) {
      out.angle_rad[i] = r.angle_rad[order[i]];
      out.height_m[i] = r.height_m[order[i]];
      out.tilt_a_rad[i] = r.tilt_a_rad[order[i]];
      out.tilt_b_rad[i] = r.tilt_b_rad[order[i]];
      out.axes_m[i] = r.axes_m[order[i]];
    }
    return out;
  };
  const CircleReadings two = turning_circle(20e-6, -7e-6, 0, source, 2, 3e-6);
  std::vector<std::size_t> order(two.angle_rad.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  EXPECT_TRUE(perpendicularity(arranged(two, order), 5));
  std::reverse(order.begin() + 72, order.end());
  EXPECT_TRUE(perpendicularity(arranged(two, order), 5));  // forwards and back
  std::rotate(order.begin() + 72, order.begin() + 108, order.end());
  says(arranged(two, order), "reading 73 of the circle: the angle changes by 180°");
  // Readings 19 to 36 in the reverse order: forwards, back and forwards again.
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::reverse(order.begin() + 18, order.begin() + 36);
  says(arranged(two, order), "the direction of rotation changes for the second time");
  CircleReadings scattering = two;
  for (std::size_t i = 0; i < 144; i += 2) scattering.angle_rad[i] += 0.11;  // 6.3° of steps of 5°
  EXPECT_TRUE(perpendicularity(scattering, 5));
  scattering.height_m[3] = 2;
  const auto high = perpendicularity(scattering, 5);
  ASSERT_FALSE(high);
  EXPECT_NE(high.error().message.find("limit of 1 m"), std::string::npos);
}

TEST(PerpendicularityTest, RefusesAPartOfATurn) {
  std::mt19937 source(7);
  auto r = circle(0, 0, 1e-7, source, false);
  EXPECT_FALSE(perpendicularity(r, 40));
  r.angle_rad.resize(54);
  r.height_m.resize(54);
  const auto p = perpendicularity(r, 3);
  ASSERT_FALSE(p);
  EXPECT_NE(p.error().message.find("whole turn"), std::string::npos);
}

// For equal steps of the angle, u of a coefficient is s √(2/n); s is the standard deviation of the
// residuals.
TEST(PerpendicularityTest, UncertaintyComesFromTheResiduals) {
  std::mt19937 source(8);
  CircleReadings r = circle(3e-6, 4e-6, 0, source, true);
  for (std::size_t i = 0; i < 72; ++i) r.height_m[i] += 1e-7 * std::cos(7 * r.angle_rad[i]);
  const auto p = perpendicularity(r, 5);
  ASSERT_TRUE(p) << p.error().message;
  EXPECT_EQ(p->freedom, 72 - 11);
  EXPECT_NEAR(p->residual_sd_m, 1e-7 * std::sqrt(36.0 / 61), 1e-15);
  EXPECT_NEAR(p->harmonics[0].u_m, p->residual_sd_m * std::sqrt(2.0 / 72), 1e-15);
  EXPECT_NEAR(p->u_rad, p->harmonics[0].u_m / 0.1, 1e-15);
  EXPECT_NEAR(p->size_rad, 5e-6, 1e-13);
  EXPECT_NEAR(p->k, 1.99962, 1e-4);  // coverage factor for 61 degrees of freedom
  EXPECT_NEAR(p->U_rad, p->k * p->u_rad, 1e-18);
  EXPECT_EQ(p->harmonics[4].order, 5);
  r.tilt_b_rad.clear();
  EXPECT_FALSE(perpendicularity(r, 5)->tilt_known);
}

TEST(PerpendicularityTest, RefusesFewReadingsAndGapsAbove60Degrees) {
  const auto readings = [](int n, double step_deg) {
    CircleReadings r;
    r.radius_m = 0.1;
    for (int i = 0; i < n; ++i) {
      r.angle_rad.push_back(step_deg * i * 0.017453292519943295);
      r.height_m.push_back(i % 2 ? 1e-6 : 0);
    }
    return r;
  };
  EXPECT_TRUE(perpendicularity(readings(13, 360.0 / 13), 5));
  EXPECT_FALSE(perpendicularity(readings(12, 30), 5));
  EXPECT_TRUE(perpendicularity(readings(11, 30.1), 2));   // a gap of 59°
  EXPECT_FALSE(perpendicularity(readings(11, 29.9), 2));  // a gap of 61°
  CircleReadings shifted = readings(11, 29.9);
  for (double& a : shifted.angle_rad) a -= 10;  // the same gap, at other angles of the turn
  EXPECT_FALSE(perpendicularity(shifted, 2));
  CircleReadings r = readings(13, 360.0 / 13);
  for (const double radius_m : {0.0, -0.1, 100.0}) {
    r.radius_m = radius_m;
    EXPECT_FALSE(perpendicularity(r, 1)) << radius_m;
  }
}

}  // namespace
}  // namespace mdof::algo
