#include "algo/form/pose/pose_fit.h"

#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/least_squares.h"
#include "algo/linear_algebra/spectra.h"

namespace mdof::algo {
namespace {

constexpr double kNeededOverlap = 0.6;  // least share of the places of A that have a counterpart in
                                        // B, or the share at the start pose if that is smaller
constexpr double kFitUndetermined = 1e-7;  // a direction is undetermined if a plane explains more
                                           // than 1 - this share of the slopes
constexpr double kFitted_pixels = 1e-5;    // the iteration ends after a smaller change
// Limit of Huber, Robust Statistics (1981): 1.345 sd, with 95 % efficiency for normal noise. sd =
// 1.4826 times the median of the absolute residuals.
constexpr double kHuberLimit = 1.345 * 1.4826;
constexpr double kLeastLimit_m = 1e-12;
constexpr std::size_t kForMedian = 20'000;
constexpr int kPlaneSteps = 30, kPlaneStepsAgain = 4;
// Relative to limit_m: the iteration ends after a smaller change.
constexpr double kPlaneFitted = 1e-6;

double median_left(const std::vector<double>& left_m) {
  const std::size_t every = std::max<std::size_t>(1, left_m.size() / kForMedian);
  std::vector<double> sizes;
  for (std::size_t k = 0; k < left_m.size(); k += every)
    if (!std::isnan(left_m[k])) sizes.push_back(std::abs(left_m[k]));
  if (sizes.empty()) return 0;
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle;
}

double huber_weight(double left_m, double limit_m) {
  const double size = std::abs(left_m);
  return size <= limit_m ? 1 : limit_m / size;
}

double huber_loss(double left_m, double limit_m) {
  const double size = std::abs(left_m);
  return size <= limit_m ? size * size / 2 : limit_m * (size - limit_m / 2);
}

// Fits a plane to the residuals, subtracts it from them, adds it to fit.plane and sets fit.limit_m.
void remove_fitted_plane(const Places& a, PoseFit& fit, int most) {
  const double scale = 1 / a.size_m;
  for (int step = 0; step < most; ++step) {
    Eigen::MatrixXd A = Eigen::MatrixXd::Zero(3, 3);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(3);
    for (std::size_t k = 0; k < fit.left_m.size(); ++k) {
      const double r = fit.left_m[k];
      if (std::isnan(r)) continue;
      const double w = huber_weight(r, fit.limit_m), x = a.x_m[k] * scale, y = a.y_m[k] * scale;
      A(0, 0) += w;
      A(0, 1) += w * x;
      A(0, 2) += w * y;
      A(1, 1) += w * x * x;
      A(1, 2) += w * x * y;
      A(2, 2) += w * y * y;
      b(0) += w * r;
      b(1) += w * r * x;
      b(2) += w * r * y;
    }
    A(1, 0) = A(0, 1);
    A(2, 0) = A(0, 2);
    A(2, 1) = A(1, 2);
    const Eigen::VectorXd change = LeastNorm(A, 1e-12).solve(b);
    for (std::size_t k = 0; k < fit.left_m.size(); ++k)
      fit.left_m[k] -= change(0) + change(1) * a.x_m[k] * scale + change(2) * a.y_m[k] * scale;
    for (std::size_t u = 0; u < 3; ++u) fit.plane[u] += change(static_cast<Eigen::Index>(u));
    fit.limit_m = std::max(kLeastLimit_m, kHuberLimit * median_left(fit.left_m));
    if (change.cwiseAbs().maxCoeff() < kPlaneFitted * fit.limit_m) break;
  }
}

PoseFit left_at(const Places& a, const Surface& b, const MapPose& pose,
                const std::array<double, 3>& plane) {
  PoseFit fit;
  fit.pose = pose;
  fit.plane = plane;
  const std::size_t n = a.z_m.size();
  fit.left_m.assign(n, SurfaceMap::kMissing);
  fit.slope_x.assign(n, 0);
  fit.slope_y.assign(n, 0);
  const Turn turn(pose.turn_rad);
  const double scale = 1 / a.size_m;
  for (std::size_t k = 0; k < n; ++k) {
    SurfacePoint at;
    if (!b.at(turn.x_m(a.x_m[k], a.y_m[k]) + a.x_mid_m + pose.shift_x_m,
              turn.y_m(a.x_m[k], a.y_m[k]) + a.y_mid_m + pose.shift_y_m, 0, at))
      continue;
    fit.left_m[k] =
        at.z_m - a.z_m[k] - (plane[0] + plane[1] * a.x_m[k] * scale + plane[2] * a.y_m[k] * scale);
    fit.slope_x[k] = at.slope_x;
    fit.slope_y[k] = at.slope_y;
    fit.count += 1;
  }
  return fit;
}

struct PoseSums {
  // Sums of products: P plane and plane, C plane and movements, M movements and movements.
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(3, 3), C = P, M = P;
  Eigen::VectorXd p = Eigen::VectorXd::Zero(3), m = p;
};

PoseSums pose_sums(const Places& a, const PoseFit& fit) {
  std::array<std::array<double, 6>, 6> A{};
  std::array<double, 6> b{};
  const Turn turn(fit.pose.turn_rad);
  const double scale = 1 / a.size_m;
  for (std::size_t k = 0; k < fit.left_m.size(); ++k) {
    const double r = fit.left_m[k];
    if (std::isnan(r)) continue;
    const double w = huber_weight(r, fit.limit_m), x = turn.x_m(a.x_m[k], a.y_m[k]),
                 y = turn.y_m(a.x_m[k], a.y_m[k]), sx = fit.slope_x[k], sy = fit.slope_y[k];
    const std::array<double, 6> slope = {
        {1, a.x_m[k] * scale, a.y_m[k] * scale, sx, sy, (sy * x - sx * y) * scale}};
    for (std::size_t u = 0; u < 6; ++u) {
      const double weighted = w * slope[u];
      for (std::size_t v = u; v < 6; ++v) A[u][v] += weighted * slope[v];
      b[u] += weighted * r;
    }
  }
  PoseSums sums;
  for (std::size_t u = 0; u < 3; ++u) {
    const auto i = static_cast<Eigen::Index>(u);
    sums.p(i) = b[u];
    sums.m(i) = b[u + 3];
    for (std::size_t v = 0; v < 3; ++v) {
      const auto j = static_cast<Eigen::Index>(v);
      sums.P(i, j) = A[std::min(u, v)][std::max(u, v)];
      sums.C(i, j) = A[u][v + 3];
      sums.M(i, j) = A[std::min(u, v) + 3][std::max(u, v) + 3];
    }
  }
  return sums;
}

// Change of (shift x, shift y, turn times size) in one iteration, only along `directions`.
Eigen::VectorXd pose_step(const Places& a, const PoseFit& fit, const Eigen::MatrixXd& directions) {
  const PoseSums sums = pose_sums(a, fit);
  const LeastNorm plane(sums.P, 1e-12);
  const Eigen::MatrixXd all = directions.transpose() * sums.M * directions;
  const Eigen::MatrixXd left =
      directions.transpose() * (sums.M - sums.C.transpose() * plane.solve(sums.C)) * directions;
  const Eigen::VectorXd right =
      directions.transpose() * (sums.m - sums.C.transpose() * plane.solve(sums.p));
  // Scales each unknown, so that the singular values are comparable.
  Eigen::VectorXd scale(all.rows());
  const double least = kFitUndetermined * kFitUndetermined * all.trace();  // a smaller value is
                                                                           // rounding
  for (Eigen::Index u = 0; u < all.rows(); ++u)
    scale(u) = all(u, u) > least ? 1 / std::sqrt(all(u, u)) : 0;
  const SingularValues found = singular_values(scale.asDiagonal() * left * scale.asDiagonal());
  Eigen::VectorXd change = Eigen::VectorXd::Zero(all.rows());
  for (Eigen::Index k = 0; k < found.values.size(); ++k) {
    if (!(found.values(k) > kFitUndetermined)) continue;
    const double along = found.U.col(k).dot(scale.cwiseProduct(right)) / found.values(k);
    change -= along * scale.cwiseProduct(found.V.col(k));
  }
  return directions * change;
}

// Compares the residuals over the places that have a counterpart in B in both poses.
bool is_better(const PoseFit& next, const PoseFit& now) {
  double sum = 0, before = 0;
  for (std::size_t k = 0; k < now.left_m.size(); ++k) {
    if (std::isnan(now.left_m[k]) || std::isnan(next.left_m[k])) continue;
    before += huber_loss(now.left_m[k], now.limit_m);
    sum += huber_loss(next.left_m[k], now.limit_m);
  }
  return sum < before;
}

}  // namespace

PoseFit plane_fit_at_pose(const Places& a, const Surface& b, const MapPose& pose) {
  PoseFit fit = left_at(a, b, pose, {});
  remove_fitted_plane(a, fit, kPlaneSteps);
  return fit;
}

PoseFit fitted_from(const Places& a, const Surface& b, const MapPose& start,
                    const Eigen::MatrixXd& directions, double pixel_m, int most) {
  PoseFit now = plane_fit_at_pose(a, b, start);
  if (directions.cols() == 0) return now;
  const double needed = std::min(now.count, kNeededOverlap * static_cast<double>(a.z_m.size()));
  for (int k = 0; k < most; ++k) {
    const Eigen::VectorXd change = pose_step(a, now, directions);
    const double size = change.cwiseAbs().sum();
    bool found = false;
    double part = 1;
    for (int halved = 0; halved < 6 && !found; ++halved, part /= 2) {
      MapPose pose = now.pose;
      pose.shift_x_m += part * change(0);
      pose.shift_y_m += part * change(1);
      pose.turn_rad += part * change(2) / a.size_m;
      PoseFit next = left_at(a, b, pose, now.plane);
      if (next.count >= needed) {
        next.limit_m = now.limit_m;
        remove_fitted_plane(a, next, kPlaneStepsAgain);
        found = is_better(next, now);
      }
      if (found) now = std::move(next);
      if (size * part < kFitted_pixels * pixel_m) break;
    }
    if (!found || size < kFitted_pixels * pixel_m) break;
  }
  return now;
}

MeanLeft mean_left(const PoseFit& fit, const std::vector<bool>& counts, double most_m) {
  MeanLeft mean;
  for (std::size_t k = 0; k < fit.left_m.size(); ++k) {
    if (!counts[k] || std::isnan(fit.left_m[k])) continue;
    mean.size_m += std::min(most_m, std::abs(fit.left_m[k]));
    mean.share += 1;
  }
  if (mean.share == 0) return mean;
  mean.size_m /= mean.share;
  mean.share /= static_cast<double>(fit.left_m.size());
  return mean;
}

double mean_square_at(const Places& a, const Surface& b, const MapPose& pose, double least_share) {
  Eigen::MatrixXd P = Eigen::MatrixXd::Zero(3, 3);
  Eigen::VectorXd p = Eigen::VectorXd::Zero(3);
  double squares = 0, count = 0;
  const Turn turn(pose.turn_rad);
  const double scale = 1 / a.size_m;
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    SurfacePoint at;
    if (!b.at(turn.x_m(a.x_m[k], a.y_m[k]) + a.x_mid_m + pose.shift_x_m,
              turn.y_m(a.x_m[k], a.y_m[k]) + a.y_mid_m + pose.shift_y_m, 0, at))
      continue;
    const double r = at.z_m - a.z_m[k], x = a.x_m[k] * scale, y = a.y_m[k] * scale;
    P(0, 1) += x;
    P(0, 2) += y;
    P(1, 1) += x * x;
    P(1, 2) += x * y;
    P(2, 2) += y * y;
    p(0) += r;
    p(1) += r * x;
    p(2) += r * y;
    squares += r * r;
    count += 1;
  }
  if (count == 0 || count < least_share * static_cast<double>(a.z_m.size())) return -1;
  P(0, 0) = count;
  P(1, 0) = P(0, 1);
  P(2, 0) = P(0, 2);
  P(2, 1) = P(1, 2);
  return std::max(0.0, squares - p.dot(LeastNorm(P, 1e-12).solve(p))) / count;
}

}  // namespace mdof::algo
