#include "algo/form/evidence/shape_evidence.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "algo/linear_algebra/least_squares.h"
#include "algo/linear_algebra/spectra.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kEvidencePlaces = 50'000;
constexpr double kNoSlope = 1e-7;  // share of the slopes, as in registration.cpp
// Slopes by noise have the correlation 0 +- 1 / sqrt(places); neighbours share some of it, and the
// fit looks for the largest.
constexpr double kEvidenceNeeded = 8, kEvidenceEnough = 0.5;

using Moves = Eigen::Vector3d;  // what shift x, shift y and turn change of a height

// Sums over places: of the plane, and of what the movements do by the slopes of either map.
struct Evidence {
  Eigen::Matrix3d plane = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d plane_a = Eigen::Matrix3d::Zero(), plane_b = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d aa = Eigen::Matrix3d::Zero(), ab = Eigen::Matrix3d::Zero(),
                  bb = Eigen::Matrix3d::Zero();
  double count = 0;

  void add(const Eigen::Vector3d& at, const Moves& a, const Moves& b) {
    plane += at * at.transpose();
    plane_a += at * a.transpose();
    plane_b += at * b.transpose();
    aa += a * a.transpose();
    ab += a * b.transpose();
    bb += b * b.transpose();
    count += 1;
  }
  // Without what a tilt explains.
  void eliminate_plane() {
    const LeastNorm fit(plane, 1e-12);
    const Eigen::Matrix3d by_a = fit.solve(Eigen::MatrixXd(plane_a)),
                          by_b = fit.solve(Eigen::MatrixXd(plane_b));
    aa -= plane_a.transpose() * by_a;
    ab -= plane_a.transpose() * by_b;
    bb -= plane_b.transpose() * by_b;
  }
};

// By the pixels beside it; false: one of them is missing.
bool slope_of(const SurfaceMap& map, std::size_t i, std::size_t j, Eigen::Vector2d& slope) {
  if (i == 0 || j == 0 || i + 1 >= map.nx || j + 1 >= map.ny) return false;
  slope = {(map.at(i + 1, j) - map.at(i - 1, j)) / (2 * map.dx_m),
           (map.at(i, j + 1) - map.at(i, j - 1)) / (2 * map.dy_m)};
  return std::isfinite(slope.sum());
}

Moves moves(const Eigen::Vector2d& slope, const Eigen::Vector2d& arm) {
  return {slope.x(), slope.y(), slope.y() * arm.x() - slope.x() * arm.y()};
}

Evidence evidence_of(const SurfaceMap& a, const Surface& b, const MapPose& pose) {
  Evidence evidence;
  const std::size_t every = std::max<std::size_t>(1, a.z_m.size() / kEvidencePlaces);
  const double turns = pose.turn_rad / (2 * std::numbers::pi);
  const double c = sine_of_turns(turns + 0.25), s = sine_of_turns(turns);
  const Eigen::Matrix2d turn{{c, -s}, {s, c}};
  const Eigen::Vector2d middle((a.x_m(0) + a.x_m(a.nx - 1)) / 2, (a.y_m(0) + a.y_m(a.ny - 1)) / 2);
  const double size =
      std::max(static_cast<double>(a.nx) * a.dx_m, static_cast<double>(a.ny) * a.dy_m);
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    // Spread without a common factor with the rows.
    if (every > 1 && (k * 0x9e3779b97f4a7c15u >> 33) % every != 0) continue;
    Eigen::Vector2d slope_a;
    if (std::isnan(a.z_m[k]) || !slope_of(a, k % a.nx, k / a.nx, slope_a)) continue;
    const Eigen::Vector2d p(a.x_m(k % a.nx), a.y_m(k / a.nx));
    const Eigen::Vector2d q = turn * p + Eigen::Vector2d(pose.shift_x_m, pose.shift_y_m);
    SurfacePoint at;
    if (!b.at(q.x(), q.y(), 0, at)) continue;
    const Eigen::Vector2d arm = turn * ((p - middle) / size);
    evidence.add({1, arm.x(), arm.y()}, moves(turn * slope_a, arm),
                 moves({at.slope_x, at.slope_y}, arm));
  }
  return evidence;
}

}  // namespace

std::size_t directions_without_shape(const SurfaceMap& a, const Surface& b, const MapPose& pose) {
  Evidence evidence = evidence_of(a, b, pose);
  const Eigen::Matrix3d raw = (evidence.aa + evidence.bb) / 2;
  evidence.eliminate_plane();
  const Eigen::Matrix3d all = (evidence.aa + evidence.bb) / 2,
                        common = (evidence.ab + evidence.ab.transpose()) / 2;
  // Each movement in its own scale, then each direction in that of its slopes.
  Eigen::Vector3d scale;
  const double least = kNoSlope * kNoSlope * raw.trace();
  for (Eigen::Index k = 0; k < 3; ++k) scale(k) = raw(k, k) > least ? 1 / std::sqrt(raw(k, k)) : 0;
  const SingularValues found = singular_values(scale.asDiagonal() * all * scale.asDiagonal());
  const double enough =
      std::min(kEvidenceEnough, kEvidenceNeeded / std::sqrt(std::max(1.0, evidence.count)));
  Eigen::MatrixXd directions(3, 0);
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (!(found.values(k) > kNoSlope)) continue;
    directions.conservativeResize(3, directions.cols() + 1);
    directions.rightCols(1) = scale.cwiseProduct(found.U.col(k)) / std::sqrt(found.values(k));
  }
  if (directions.cols() == 0) return 3;
  const Eigen::VectorXd correlation =
      symmetric_eigenvalues(directions.transpose() * common * directions);
  return 3 - static_cast<std::size_t>(std::count_if(correlation.begin(), correlation.end(),
                                                    [enough](double r) { return r >= enough; }));
}

}  // namespace mdof::algo
