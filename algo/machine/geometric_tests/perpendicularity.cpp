#include "algo/machine/geometric_tests/perpendicularity.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "algo/uncertainty/coverage.h"
#include "schema/base/number/number_text.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kWidestGap_rad = kTurn / 6;
constexpr double kLeastTurnsForDrift = 1 + 1.0 / 6;
constexpr double kMostHeight_m = 1;

double sine(double angle_rad) {
  return sine_of_turns(angle_rad / kTurn);
}
double cosine(double angle_rad) {
  return sine_of_turns(angle_rad / kTurn + 0.25);
}

double widest_gap(const std::vector<double>& angles) {
  std::vector<double> at;
  for (const double a : angles) at.push_back(a - kTurn * std::floor(a / kTurn));
  std::sort(at.begin(), at.end());
  double widest = at.front() + kTurn - at.back();
  for (std::size_t i = 1; i < at.size(); ++i) widest = std::max(widest, at[i] - at[i - 1]);
  return widest;
}

// The rotation from the reading i - 1 to the reading i in turns, taken as the shorter one of the
// two possible rotations.
double step_in_turns(const std::vector<double>& angles, std::size_t i) {
  const double step = (angles[i] - angles[i - 1]) / kTurn;
  return step - std::round(step);
}

// Sum of the absolute rotations between successive readings, in turns.
double turns_of(const std::vector<double>& angles) {
  double turns = 0;
  for (std::size_t i = 1; i < angles.size(); ++i) turns += std::abs(step_in_turns(angles, i));
  return turns;
}

tl::unexpected<Error> not_in_order(std::size_t i, const std::string& why) {
  return bad_input("reading " + std::to_string(i + 1) + " of the circle: " + why +
                   ", so the readings are probably not in the order of time; sort the readings, or "
                   "give the time of each reading (time_s)");
}

// Readings without times. Errors: a step of more than 90°; more than one change of the direction.
// Rotations of less than kBack are not a change of the direction.
Status check_order(const std::vector<double>& angles) {
  constexpr double kLongestStep = 0.25 + 1e-6, kBack = 5.0 / 360;  // in turns
  double at = 0, farthest = 0, direction = 0;
  int changes = 0;
  for (std::size_t i = 1; i < angles.size(); ++i) {
    const double step = step_in_turns(angles, i);
    if (std::abs(step) > kLongestStep)
      return not_in_order(i, "the angle changes by " + plain_number(360 * std::abs(step), 3) +
                                 "° from the reading before (limit 90°)");
    at += step;
    if ((at - farthest) * direction > 0) {
      farthest = at;
    } else if (std::abs(at - farthest) > kBack) {
      changes += direction == 0 ? 0 : 1;
      direction = at > farthest ? 1 : -1;
      farthest = at;
    }
    if (changes > 1)
      return not_in_order(i, "the direction of rotation changes for the second time (limit 1)");
  }
  return {};
}

// Time of each reading since the first reading, divided by the total time (0 to 1).
Result<Eigen::VectorXd> times_of(const CircleReadings& r) {
  const auto n = static_cast<Eigen::Index>(r.angle_rad.size());
  if (r.time_s.empty()) {
    MDOF_CHECK(check_order(r.angle_rad));
    return Eigen::VectorXd::LinSpaced(n, 0, 1);
  }
  Eigen::VectorXd share(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i > 0 && !(r.time_s[at] > r.time_s[at - 1]))
      return bad_input("reading " + std::to_string(i + 1) +
                       " of the circle is not later than the reading before; give the readings in "
                       "the order of their times");
    share[i] = (r.time_s[at] - r.time_s.front()) / (r.time_s.back() - r.time_s.front());
  }
  return share;
}

Status check(const CircleReadings& r, int highest, bool drift) {
  const std::size_t n = r.angle_rad.size(),
                    unknowns = 2 * static_cast<std::size_t>(highest) + (drift ? 2 : 1);
  if (!(r.radius_m > 0 && r.radius_m < 100))
    return bad_input("the radius of the circle must be above 0 and below 100 m");
  if (n < unknowns + 2)
    return bad_input(std::to_string(n) + (n == 1 ? " reading is" : " readings are") +
                     " too few for " + std::to_string(highest) + " harmonics; give at least " +
                     std::to_string(unknowns + 2) + " readings, or fewer harmonics");
  for (const auto* heights : {&r.height_m, &r.axes_m})
    for (const double height_m : *heights)
      if (!(std::abs(height_m) <= kMostHeight_m))
        return bad_input("a height of " + plain_number(to_um(height_m)) +
                         " um is above the limit of 1 m; check the unit");
  if (widest_gap(r.angle_rad) > kWidestGap_rad)
    return bad_input(
        "the readings have a gap of more than 60° on the circle, so the first harmonic cannot be "
        "separated from the others; measure a whole turn");
  return {};
}

}  // namespace

Result<Perpendicularity> perpendicularity(const CircleReadings& r, int highest) {
  Perpendicularity p;
  p.turns = turns_of(r.angle_rad);
  p.drift_fitted = p.turns > kLeastTurnsForDrift;
  MDOF_CHECK(check(r, highest, p.drift_fitted));
  MDOF_TRY(const Eigen::VectorXd time, times_of(r));
  const auto n = static_cast<Eigen::Index>(r.angle_rad.size());
  Eigen::MatrixXd A(n, 2 * highest + (p.drift_fitted ? 2 : 1));
  if (p.drift_fitted) A.rightCols<1>() = time.array() - 0.5;
  Eigen::VectorXd h(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double angle = r.angle_rad[at];
    A(i, 0) = 1;
    for (int k = 1; k <= highest; ++k) {
      A(i, 2 * k - 1) = cosine(k * angle);
      A(i, 2 * k) = sine(k * angle);
    }
    h[i] = r.height_m[at];
    if (!r.tilt_a_rad.empty()) h[i] -= r.radius_m * r.tilt_a_rad[at] * sine(angle);
    if (!r.tilt_b_rad.empty()) h[i] += r.radius_m * r.tilt_b_rad[at] * cosine(angle);
    if (!r.axes_m.empty()) h[i] -= r.axes_m[at];
  }
  const Eigen::LDLT<Eigen::MatrixXd> normal(A.transpose() * A);
  if (normal.rcond() < 1e-9)
    return bad_input(
        "the angles of the readings do not determine so many harmonics; give fewer harmonics");
  const Eigen::VectorXd x = normal.solve(A.transpose() * h);
  const Eigen::MatrixXd covariance = normal.solve(Eigen::MatrixXd::Identity(A.cols(), A.cols()));
  p.freedom = static_cast<double>(n - A.cols());
  p.residual_sd_m = (h - A * x).norm() / std::sqrt(p.freedom);
  const auto u_of = [&](Eigen::Index k) { return p.residual_sd_m * std::sqrt(covariance(k, k)); };
  p.mean_m = x[0];
  if (p.drift_fitted) {
    p.drift_m = x[A.cols() - 1];
    p.u_drift_m = u_of(A.cols() - 1);
  }
  for (int k = 1; k <= highest; ++k)
    p.harmonics.push_back({k, x[2 * k - 1], x[2 * k], std::max(u_of(2 * k - 1), u_of(2 * k))});
  p.EA0C_rad = x[2] / r.radius_m;
  p.EB0C_rad = -x[1] / r.radius_m;
  p.size_rad = std::hypot(p.EA0C_rad, p.EB0C_rad);
  p.u_rad = p.harmonics[0].u_m / r.radius_m;
  p.k = coverage_factor(p.freedom);
  p.U_rad = p.k * p.u_rad;
  p.tilt_known = !r.tilt_a_rad.empty() && !r.tilt_b_rad.empty();
  p.axes_known = !r.axes_m.empty();
  return p;
}

}  // namespace mdof::algo
