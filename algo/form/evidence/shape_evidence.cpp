#include "algo/form/evidence/shape_evidence.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "algo/linear_algebra/least_squares.h"
#include "algo/linear_algebra/spectra.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kEvidencePlaces = 50'000;
constexpr double kNoSlope = 1e-7;  // relative to all slopes: smaller slopes are rounding
// A direction needs a correlation of the slopes of kEvidenceNeeded / sqrt(places), at most
// kEvidenceEnough. Noise alone has the correlation 0 +- 1 / sqrt(places). The factor is large
// because slopes of neighbours have common noise and the fit finds the largest correlation.
constexpr double kEvidenceNeeded = 8, kEvidenceEnough = 0.5;

// Change of a height by a unit of shift x, shift y and turn times size.
using Moves = Eigen::Vector3d;

// Sums over places, of products of the terms of the plane and the movements of each map.
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
  // Removes the part of the movements that piston and tilt explain.
  void eliminate_plane() {
    const LeastNorm fit(plane, 1e-12);
    const Eigen::Matrix3d by_a = fit.solve(Eigen::MatrixXd(plane_a)),
                          by_b = fit.solve(Eigen::MatrixXd(plane_b));
    aa -= plane_a.transpose() * by_a;
    ab -= plane_a.transpose() * by_b;
    bb -= plane_b.transpose() * by_b;
  }

  // The directions in which the slopes of A and B are correlated: orthonormal columns, orthogonal
  // to all directions without a sufficient correlation.
  Eigen::MatrixXd determined() {
    const Eigen::Matrix3d raw = (aa + bb) / 2;
    eliminate_plane();
    const Eigen::Matrix3d all = (aa + bb) / 2, common = (ab + ab.transpose()) / 2;
    // Scales each movement by its own sum of squares, and then each direction by its slopes.
    Eigen::Vector3d scale;
    const double least = kNoSlope * kNoSlope * raw.trace();
    for (Eigen::Index k = 0; k < 3; ++k)
      scale(k) = raw(k, k) > least ? 1 / std::sqrt(raw(k, k)) : 0;
    const SingularValues found = singular_values(scale.asDiagonal() * all * scale.asDiagonal());
    const double enough =
        std::min(kEvidenceEnough, kEvidenceNeeded / std::sqrt(std::max(1., count)));
    Eigen::MatrixXd with_slope(3, 0), without(3, 0);
    const auto append = [](Eigen::MatrixXd& to, const Eigen::VectorXd& column) {
      to.conservativeResize(3, to.cols() + 1);
      to.rightCols(1) = column;
    };
    for (Eigen::Index k = 0; k < 3; ++k)
      if (found.values(k) > kNoSlope)
        append(with_slope, scale.cwiseProduct(found.U.col(k)) / std::sqrt(found.values(k)));
      else
        append(without, unscaled(found.U.col(k), scale));
    const Eigen::Index n = with_slope.cols();
    if (n > 0) {
      // Correlations are in [-1, 1]. Adding 2 makes all eigenvalues positive, so that the singular
      // values are the eigenvalues.
      const SingularValues by_both = singular_values(with_slope.transpose() * common * with_slope +
                                                     2 * Eigen::MatrixXd::Identity(n, n));
      for (Eigen::Index k = 0; k < n; ++k)
        if (by_both.values(k) - 2 < enough) append(without, with_slope * by_both.U.col(k));
    }
    return orthogonal_to(without);
  }

 private:
  // Converts a direction from scaled movements to movements. A movement whose scale is 0 (no
  // slopes) is a direction of its own.
  static Eigen::VectorXd unscaled(const Eigen::VectorXd& u, const Eigen::Vector3d& scale) {
    Eigen::VectorXd direction(3);
    const bool has_none = (u.array().abs() * (scale.array() == 0).cast<double>()).maxCoeff() > 0.5;
    for (Eigen::Index k = 0; k < 3; ++k)
      direction(k) = has_none ? (scale(k) == 0 ? u(k) : 0) : u(k) * scale(k);
    return direction;
  }
  static Eigen::MatrixXd orthogonal_to(const Eigen::MatrixXd& without) {
    if (without.cols() == 0) return Eigen::MatrixXd::Identity(3, 3);
    if (without.cols() == 3) return Eigen::MatrixXd(3, 0);
    Eigen::MatrixXd unit = without;
    for (Eigen::Index k = 0; k < unit.cols(); ++k) unit.col(k) /= unit.col(k).norm();
    return LeastNorm(unit.transpose(), 1e-9).null_space();
  }
};

// Slope from the neighbouring pixels. False: one of these pixels is missing. In a map of one row or
// column, the slope across it is 0.
bool slope_of(const SurfaceMap& map, std::size_t i, std::size_t j, Eigen::Vector2d& slope) {
  const auto along = [&](std::size_t k, std::size_t n, double step_m, std::size_t next) {
    if (n == 1) return 0.0;
    const std::size_t at = j * map.nx + i;
    if (k == 0 || k + 1 >= n) return SurfaceMap::kMissing;
    return (map.z_m[at + next] - map.z_m[at - next]) / (2 * step_m);
  };
  slope = {along(i, map.nx, map.dx_m, 1), along(j, map.ny, map.dy_m, map.nx)};
  return std::isfinite(slope.sum());
}

Moves moves(const Eigen::Vector2d& slope, const Eigen::Vector2d& arm) {
  return {slope.x(), slope.y(), slope.y() * arm.x() - slope.x() * arm.y()};
}

}  // namespace

ShapeEvidence::ShapeEvidence(const SurfaceMap& a, const Places& about)
    : x_mid_m_(about.x_mid_m), y_mid_m_(about.y_mid_m), size_m_(about.size_m) {
  const std::size_t every = std::max<std::size_t>(1, a.z_m.size() / kEvidencePlaces);
  for (std::size_t k = 0; k < a.z_m.size(); ++k) {
    // Selects pixels by a hash of their number, as places_of() does.
    if (every > 1 && (k * 0x9e3779b97f4a7c15u >> 33) % every != 0) continue;
    Eigen::Vector2d slope;
    if (std::isnan(a.z_m[k]) || !slope_of(a, k % a.nx, k / a.nx, slope)) continue;
    places_.push_back(
        {a.x_m(k % a.nx) - x_mid_m_, a.y_m(k / a.nx) - y_mid_m_, slope.x(), slope.y()});
  }
}

bool ShapeEvidence::has_shape() const {
  Evidence evidence;
  for (const Place& p : places_) {
    const Eigen::Vector2d arm = Eigen::Vector2d(p.x_m, p.y_m) / size_m_;
    const Moves of_a = moves({p.slope_x, p.slope_y}, arm);
    evidence.add({1, arm.x(), arm.y()}, of_a, of_a);
  }
  return evidence.determined().cols() > 0;
}

Eigen::MatrixXd ShapeEvidence::determined(const Surface& b, const MapPose& about_middle) const {
  Evidence evidence;
  const Turn turn(about_middle.turn_rad);
  for (const Place& p : places_) {
    const Eigen::Vector2d q(turn.x_m(p.x_m, p.y_m), turn.y_m(p.x_m, p.y_m));
    SurfacePoint at;
    if (!b.at(q.x() + x_mid_m_ + about_middle.shift_x_m, q.y() + y_mid_m_ + about_middle.shift_y_m,
              0, at))
      continue;
    const Eigen::Vector2d arm = q / size_m_,
                          slope_a(turn.x_m(p.slope_x, p.slope_y), turn.y_m(p.slope_x, p.slope_y));
    evidence.add({1, arm.x(), arm.y()}, moves(slope_a, arm), moves({at.slope_x, at.slope_y}, arm));
  }
  return evidence.determined();
}

}  // namespace mdof::algo
