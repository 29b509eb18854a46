#include "algo/model/rigid.h"

#include <cmath>

#include "algo/linear_algebra/least_squares.h"
#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

constexpr int kMaxIterations = 30;
// Convergence is quadratic: if a step is below these limits, the next step is only a rounding
// error.
constexpr double kStepDone_m = 1e-12, kStepDone_rad = 1e-10;

struct Surface {
  Eigen::Vector3d n_M;  // normal of the rotated plane
  double across;        // n_M · u
  double s;             // displacement along u
};

Eigen::Vector3d carriage_position(double travel_m, const Errors5& local) {
  return {travel_m, local[kDy], local[kDz]};
}

// Calculates the intersection of the probe's measuring line and the surface. With a height map it
// uses a fixed-point iteration. Each iteration reduces the error by a factor equal to the slope of
// the surface (1e-3 and less).
Surface meet(const FixtureProbe& probe, const Eigen::Matrix3d& R_MC, const Eigen::Vector3d& t) {
  Surface surface;
  surface.n_M = R_MC * probe.n_C;
  surface.across = surface.n_M.dot(probe.u_M);
  const double gap = probe.plane_offset_m - surface.n_M.dot(probe.p_MP - t);
  surface.s = gap / surface.across;
  if (probe.flatness.empty()) return surface;
  Eigen::Index normal_axis = 0;
  probe.n_C.cwiseAbs().maxCoeff(&normal_axis);
  const Eigen::Index first = normal_axis == 0 ? 1 : 0;
  const Eigen::Index second = normal_axis == 2 ? 1 : 2;
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d c = R_MC.transpose() * (probe.p_MP + surface.s * probe.u_M - t);
    surface.s = (gap + height_at(probe.flatness, c(first), c(second))) / surface.across;
  }
  return surface;
}

}  // namespace

Eigen::VectorXd rigid_readings(const Fixture& fixture, double travel_m, const Errors5& local) {
  const Eigen::Matrix3d R_MC = local_rotation_matrix(fixture.axis, local);
  const Eigen::Vector3d t = carriage_position(travel_m, local);
  Eigen::VectorXd readings(static_cast<Eigen::Index>(fixture.probes.size()));
  Eigen::Index i = 0;
  for (const auto& probe : fixture.probes) readings(i++) = meet(probe, R_MC, t).s;
  return readings;
}

Eigen::MatrixXd rigid_jacobian(const Fixture& fixture, double travel_m, const Errors5& local) {
  const Rotation r = local_rotation(fixture.axis, local);
  const Eigen::Vector3d t = carriage_position(travel_m, local);
  Eigen::MatrixXd J(static_cast<Eigen::Index>(fixture.probes.size()), kErrorCount);
  Eigen::Index i = 0;
  for (const auto& probe : fixture.probes) {
    const Surface at = meet(probe, r.R_MC, t);
    J(i, kDy) = at.n_M.y() / at.across;
    J(i, kDz) = at.n_M.z() / at.across;
    // s across = k - n_M·(P - t)  =>  ds = -dn_M·(P - t + s u)/across
    const Eigen::Vector3d arm = probe.p_MP - t + at.s * probe.u_M;
    for (std::size_t e = 0; e < 3; ++e) {
      J(i, kEx + static_cast<int>(e)) = -(r.dR_MC[e] * probe.n_C).dot(arm) / at.across;
    }
    ++i;
  }
  return J;
}

AxisErrors solve_rigid(const Fixture& fixture, double travel_m,
                       const std::vector<double>& readings_m, const std::vector<double>& weights) {
  const auto n = static_cast<Eigen::Index>(fixture.probes.size());
  Eigen::VectorXd root_weight(n), readings(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    root_weight(i) = std::sqrt(weights[k]);
    readings(i) = weights[k] > 0 ? readings_m[k] : 0.0;
  }
  AxisErrors result;
  Errors5 e{};
  bool done = false;
  for (int iteration = 0; iteration < kMaxIterations && !done; ++iteration) {
    const Eigen::VectorXd misfit = readings - rigid_readings(fixture, travel_m, e);
    const Eigen::MatrixXd J = rigid_jacobian(fixture, travel_m, e);
    const Eigen::VectorXd step = LeastSquares(root_weight.asDiagonal() * J)
                                     .solve(Eigen::VectorXd(root_weight.asDiagonal() * misfit));
    for (std::size_t k = 0; k < e.size(); ++k) e[k] += step(static_cast<Eigen::Index>(k));
    const bool inside = std::abs(e[kEx]) < kSmallAngleMax_rad &&
                        std::abs(e[kEy]) < kSmallAngleMax_rad &&
                        std::abs(e[kEz]) < kSmallAngleMax_rad;
    if (!inside) {
      result.reason =
          "the readings give a rotation above 0.25 rad; check the rig's positions, directions and "
          "units";
      return result;
    }
    done = std::abs(step(0)) <= kStepDone_m && std::abs(step(1)) <= kStepDone_m &&
           step.tail(3).cwiseAbs().maxCoeff() <= kStepDone_rad;
  }
  if (!done) {
    result.reason =
        "the solution does not converge for these readings; check the height maps of the rig's "
        "planes (flatness_um is in um, flatness_first_mm and flatness_second_mm in mm)";
    return result;
  }
  double sum = 0, count = 0;
  const Eigen::VectorXd left = readings - rigid_readings(fixture, travel_m, e);
  for (Eigen::Index i = 0; i < n; ++i) {
    if (root_weight(i) <= 0) continue;
    sum += left(i) * left(i);
    count += 1;
  }
  result.local = e;
  result.residual_m = std::sqrt(sum / count);
  result.valid = true;
  result.reason.clear();
  return result;
}

}  // namespace mdof::algo
