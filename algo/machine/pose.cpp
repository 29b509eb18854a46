#include "algo/machine/pose.h"

#include <cmath>
#include <numbers>

#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr double kTurn_rad = 2 * std::numbers::pi;

// asin of a small number: solves sin(x) = s by Newton's method.
double small_asin(double s) {
  double x = s + s * s * s / 6;
  for (int i = 0; i < 4; ++i) x -= (tiny_sin(x) - s) / tiny_cos(x);
  return x;
}

// atan(y / x), for a small quotient.
double small_atan(double y, double x) {
  return small_asin(y / std::sqrt(x * x + y * y));
}

}  // namespace

Eigen::Vector3d vector_of(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

Eigen::Matrix3d tiny_rotation(double a, double b, double c) {
  const double sa = tiny_sin(a), ca = tiny_cos(a), sb = tiny_sin(b), cb = tiny_cos(b);
  const double sc = tiny_sin(c), cc = tiny_cos(c);
  Eigen::Matrix3d R;
  R << cc * cb, cc * sb * sa - sc * ca, cc * sb * ca + sc * sa,  //
      sc * cb, sc * sb * sa + cc * ca, sc * sb * ca - cc * sa,   //
      -sb, cb * sa, cb * ca;
  return R;
}

Eigen::Matrix3d turn_about(std::size_t direction, double angle_rad) {
  const double s = sine_of_turns(angle_rad / kTurn_rad);
  const double c = sine_of_turns(angle_rad / kTurn_rad + 0.25);
  const auto i = static_cast<Eigen::Index>((direction + 1) % 3);
  const auto j = static_cast<Eigen::Index>((direction + 2) % 3);
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();
  R(i, i) = R(j, j) = c;
  R(i, j) = -s;
  R(j, i) = s;
  return R;
}

Eigen::Vector3d small_angles_of(const Eigen::Matrix3d& R) {
  return {small_atan(R(2, 1), R(2, 2)), -small_asin(R(2, 0)), small_atan(R(1, 0), R(0, 0))};
}

}  // namespace mdof::algo
