#include "algo/calibration/mounting_model.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "algo/model/rigid.h"
#include "algo/model/small_rotation.h"

namespace mdof::algo {
namespace {

// Typical standard uncertainty of clamping by hand, used if the rig declares no uncertainty.
constexpr double kHandClamping_m = 50e-6, kHandClamping_rad = 2e-3;
constexpr double kAngleUnit_rad = 0.01;
constexpr double kExactReading_m = 1e-10;  // smallest u of a reading; simulated logs can have u = 0

Eigen::Vector3d local(Axis axis, const Vec3& machine) {
  const Vec3 l = to_local(axis, machine);
  return {l[0], l[1], l[2]};
}

// Two unit vectors that are perpendicular to v and to each other. The two vectors are near the two
// local axes that have the largest angles to v.
std::array<Eigen::Vector3d, 2> across(const Eigen::Vector3d& v) {
  Eigen::Index nearest = 0;
  v.cwiseAbs().maxCoeff(&nearest);
  std::array<Eigen::Vector3d, 2> two;
  std::size_t n = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (k == nearest) continue;
    Eigen::Vector3d e = Eigen::Vector3d::Unit(k);
    e -= e.dot(v) * v;
    if (n == 1) e -= e.dot(two[0]) * two[0];
    two[n++] = e.normalized();
  }
  return two;
}

Vec3 unit_of(Axis axis) {
  Vec3 v{};
  v[static_cast<std::size_t>(axis)] = 1;
  return v;
}

}  // namespace

Result<MountingModel> MountingModel::create(const Rig& rig,
                                            const std::vector<Clamping>& clampings) {
  MountingModel model;
  MDOF_TRY(model.nominal_, make_fixture(rig));
  for (const FixtureProbe& probe : model.nominal_.probes) {
    model.along_.push_back(across(probe.n_C));
    model.towards_.push_back(across(probe.u_M));
  }
  model.set_scales(rig);
  model.take(clampings);
  return model;
}

void MountingModel::take(const std::vector<Clamping>& clampings) {
  for (const Clamping& clamping : clampings) {
    for (const Traverse& traverse : clamping.traverses) {
      const Eigen::Vector3d way = local(nominal_.axis, unit_of(traverse.axis));
      for (const TraverseStop& stop : traverse.stops)
        for (std::size_t k = 0; k < probes(); ++k)
          if (std::isfinite(stop.reading_m[k]))
            readings_.push_back({clampings_, traverses_, k, way, stop.travel_m, stop.reading_m[k],
                                 std::max(stop.u_reading_m[k], kExactReading_m)});
      ++traverses_;
    }
    ++clampings_;
  }
}

// The prior uncertainty of the zero is half the range. The declared u_calibration_um cannot be
// used, because the zero depends on the height at which the probe was clamped.
void MountingModel::set_scales(const Rig& rig) {
  scale_ = Eigen::VectorXd::Zero(unknowns());
  declared_.assign(static_cast<std::size_t>(unknowns()), false);
  const auto set = [&](Eigen::Index which, double declared, double by_hand) {
    declared_[static_cast<std::size_t>(which)] = declared > 0;
    scale_(which) = declared > 0 ? declared : by_hand;
  };
  for (std::size_t k = 0; k < probes(); ++k) {
    const ProbeUncertainty& u = rig.probes[k].uncertainty;
    const auto axes = local_axes(rig.axis);
    for (std::size_t j = 0; j < 2; ++j) {
      double squared = 0;  // variance along the vector, from the u along the axes of the machine
      for (std::size_t m = 0; m < 3; ++m) {
        double part = 0;
        for (std::size_t l = 0; l < 3; ++l)
          part += axes[m][l] * along_[k][j](static_cast<Eigen::Index>(l));
        squared += part * part * u.position.u[m] * u.position.u[m];
      }
      set(unknown_of(k, j == 0 ? kPlace1 : kPlace2), std::sqrt(squared), kHandClamping_m);
      set(unknown_of(k, j == 0 ? kTowards1 : kTowards2), u.direction.u, kHandClamping_rad);
    }
    set(unknown_of(k, kZero), 0, rig.probes[k].range_m / 2);
    set(unknown_of(k, kScale), u.sensitivity.u, 0);
  }
}

Eigen::Index MountingModel::unknowns() const {
  return static_cast<Eigen::Index>(probes()) * kMountingUnknowns;
}

Eigen::Index MountingModel::pose_unknowns() const {
  return static_cast<Eigen::Index>(3 * clampings_ + 2 * traverses_);
}

const Eigen::Vector3d& MountingModel::along(std::size_t probe, std::size_t which) const {
  return along_[probe][which];
}

const Eigen::Vector3d& MountingModel::towards(std::size_t probe, std::size_t which) const {
  return towards_[probe][which];
}

bool MountingModel::declared(Eigen::Index unknown) const {
  return declared_[static_cast<std::size_t>(unknown)];
}

Eigen::Vector3d MountingModel::rotated_direction(std::size_t probe, double towards1,
                                                 double towards2) const {
  const auto& two = towards_[probe];
  return (nominal_.probes[probe].u_M + towards1 * two[0] + towards2 * two[1]).normalized();
}

Errors5 MountingModel::clamping_angles(const Eigen::VectorXd& pose, std::size_t clamping) const {
  Errors5 errors{};
  const auto first = static_cast<Eigen::Index>(3 * clamping);
  for (std::size_t e = 0; e < 3; ++e)
    errors[kEx + e] = pose(first + static_cast<Eigen::Index>(e)) * kAngleUnit_rad;
  return errors;
}

// Adds the y and z components of the travel to the offsets δy and δz. The caller gives the x
// component to rigid_readings() as travel_m.
Errors5 MountingModel::pose_of(const Eigen::VectorXd& pose, const TraverseReading& at) const {
  Errors5 errors = clamping_angles(pose, at.clamping);
  const auto first = static_cast<Eigen::Index>(3 * clampings_ + 2 * at.traverse);
  errors[kDy] = pose(first) + at.travel_M().y();
  errors[kDz] = pose(first + 1) + at.travel_M().z();
  return errors;
}

FixtureProbe MountingModel::mounted(const Eigen::VectorXd& probe, std::size_t k) const {
  FixtureProbe p = nominal_.probes[k];
  const auto value = [&](MountingUnknown which) {
    return probe(unknown_of(k, which)) * scale_(unknown_of(k, which));
  };
  p.p_MP += value(kPlace1) * along_[k][0] + value(kPlace2) * along_[k][1];
  p.u_M = rotated_direction(k, value(kTowards1), value(kTowards2));
  return p;
}

MountingModel::Linearised MountingModel::linearised(const Eigen::VectorXd& pose,
                                                    const Eigen::VectorXd& probe) const {
  const auto rows = static_cast<Eigen::Index>(readings_.size());
  Linearised out{Eigen::VectorXd(rows), Eigen::MatrixXd::Zero(rows, pose_unknowns()),
                 Eigen::MatrixXd::Zero(rows, unknowns())};
  Fixture one{nominal_.axis, {FixtureProbe()}};
  for (Eigen::Index row = 0; row < rows; ++row) {
    const TraverseReading& seen = readings_[static_cast<std::size_t>(row)];
    const std::size_t k = seen.probe;
    one.probes[0] = mounted(probe, k);
    const FixtureProbe& p = one.probes[0];
    const Errors5 errors = pose_of(pose, seen);
    const double s = rigid_readings(one, seen.travel_M().x(), errors)(0);
    const Eigen::MatrixXd by_errors = rigid_jacobian(one, seen.travel_M().x(), errors);
    const Eigen::Vector3d n_M = local_rotation(nominal_.axis, errors).R_MC * p.n_C;
    const double facing = n_M.dot(p.u_M);
    const double gain = 1 + probe(unknown_of(k, kScale)) * scale_(unknown_of(k, kScale));
    const double zero = probe(unknown_of(k, kZero)) * scale_(unknown_of(k, kZero));
    out.misfit(row) = (seen.reading_m - (gain * s + zero)) / seen.u_m;
    const auto angles = static_cast<Eigen::Index>(3 * seen.clamping);
    const auto offsets = static_cast<Eigen::Index>(3 * clampings_ + 2 * seen.traverse);
    const double weight = gain / seen.u_m;
    out.by_pose.row(row).segment(angles, 3) = by_errors.row(0).tail(3) * kAngleUnit_rad * weight;
    out.by_pose.row(row).segment(offsets, 2) = by_errors.row(0).head(2) * weight;
    // Derivatives of the displacement s by the unknowns of the probe, from s n·u = k - n·(P - t)
    // with the symbols of rigid.h (n is n_M):
    //   shift of P along e: ds = -n·e / n·u
    //   change of u by du: ds = -s n·du / n·u
    const auto set = [&](MountingUnknown which, double slope) {
      out.by_probe(row, unknown_of(k, which)) = slope / seen.u_m * scale_(unknown_of(k, which));
    };
    set(kPlace1, -gain * n_M.dot(along_[k][0]) / facing);
    set(kPlace2, -gain * n_M.dot(along_[k][1]) / facing);
    set(kZero, 1);
    for (std::size_t j = 0; j < 2; ++j) {
      const Eigen::Vector3d& e = towards_[k][j];
      const Eigen::Vector3d du = e - e.dot(p.u_M) * p.u_M;  // so that the length of u stays 1
      set(j == 0 ? kTowards1 : kTowards2, -gain * s * n_M.dot(du) / facing);
    }
    set(kScale, s);
  }
  return out;
}

void MountingModel::add_encoder_uncertainty(const Eigen::VectorXd& pose, double u_encoder_m) {
  if (!(u_encoder_m > 0)) return;
  for (TraverseReading& seen : readings_) {
    const FixtureProbe& p = nominal_.probes[seen.probe];
    const Eigen::Vector3d n_M =
        local_rotation(nominal_.axis, clamping_angles(pose, seen.clamping)).R_MC * p.n_C;
    const double slope = n_M.dot(seen.axis_direction_M) / n_M.dot(p.u_M);
    seen.u_m = std::hypot(seen.u_m, slope * u_encoder_m);
  }
}

}  // namespace mdof::algo
