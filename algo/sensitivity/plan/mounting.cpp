#include "algo/sensitivity/plan/mounting.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "algo/model/rigid.h"
#include "algo/model/small_rotation.h"
#include "schema/base/random.h"

namespace mdof::algo {
namespace {

// Weights of the waves, proportional to 1/k². Their sum is 1, so that the height stays within ±
// flatness_m / 2.
constexpr std::array<double, kFlatnessWaves> kWaveWeight = {144.0 / 205, 36.0 / 205, 16.0 / 205,
                                                            9.0 / 205};

bool within(const Eigen::Vector3d& angles) {
  return angles.cwiseAbs().maxCoeff() <= kSmallAngleMax_rad;
}

Eigen::Matrix3d turned_by(const Eigen::Vector3d& angles) {
  if (angles.isZero(0)) return Eigen::Matrix3d::Identity();
  return rotation(angles.x(), angles.y(), angles.z()).R_MC;
}

void install(FixtureProbe& probe, const PartDeviation& part) {
  const Eigen::Matrix3d R = turned_by(part.turn);
  probe.p_MP = R * probe.p_MP + part.shift;
  probe.u_M = R * probe.u_M;
}

// The matrix A⁻ᵀ, which transforms normals from C to M. A = 1 + [ε]× is the upper left 3 × 3 part
// of the transform T in Eq. 1 of the paper. A⁻ᵀ is the matrix of the cofactors of A, divided by the
// determinant of A.
Eigen::Matrix3d small_angle_normals(const Errors5& e) {
  const double x = e[kEx], y = e[kEy], z = e[kEz];
  Eigen::Matrix3d cofactors;
  cofactors << 1 + x * x, x * y - z, x * z + y,  //
      x * y + z, 1 + y * y, y * z - x,           //
      x * z - y, y * z + x, 1 + z * z;
  return cofactors / (1 + x * x + y * y + z * z);
}

}  // namespace

Part part_of(const FixtureProbe& probe) {
  Eigen::Index along = 0;
  probe.u_M.cwiseAbs().maxCoeff(&along);
  return along == 2 ? Part::top : along == 1 ? Part::side : Part::fixture;
}

MountedFixture::MountedFixture(const Fixture& nominal, Forward forward, double flatness_length_m)
    : nominal_(nominal),
      cold_(nominal),
      now_(nominal),
      forward_(forward),
      flatness_length_m_(flatness_length_m),
      nominal_zero_m_(nominal.probes.size()),
      zero_m_(nominal.probes.size()) {
  for (const auto& probe : nominal.probes) {
    part_.push_back(part_of(probe));
    // Two directions perpendicular to the probe. The first is along the motion if this is possible.
    const bool along_x = std::abs(probe.u_M.x()) > 0.9;
    const Eigen::Vector3d start = along_x ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
    const Eigen::Vector3d level = start - start.dot(probe.u_M) * probe.u_M;
    first_.push_back(level / std::sqrt(level.dot(level)));
    second_.push_back(probe.u_M.cross(first_.back()));
  }
  displacements(0, {}, nominal_zero_m_);
}

bool MountedFixture::mount(const Mounting& m) {
  mounting_ = m;
  bool small = true;
  for (const auto& part : m.part) small = small && within(part.turn);
  for (const auto& plane : m.plane) small = small && within(plane.turn);
  for (std::size_t k = 0; k < probes(); ++k) {
    const ProbeDeviation& deviation = m.probe[k];
    small = small && within(deviation.turn) && std::abs(deviation.tilt_rad) <= kSmallAngleMax_rad;
    if (!small) return false;
    const FixtureProbe& nominal = nominal_.probes[k];
    FixtureProbe& probe = cold_.probes[k];
    const auto across = [&](double turns) -> Eigen::Vector3d {
      return first_[k] * sine_of_turns(turns + 0.25) + second_[k] * sine_of_turns(turns);
    };
    probe.p_MP = nominal.p_MP + deviation.shift;
    if (deviation.circle_m != 0) probe.p_MP += deviation.circle_m * across(deviation.circle_turns);
    probe.u_M = turned_by(deviation.turn) * nominal.u_M;
    if (deviation.tilt_rad != 0) {
      const auto [sine, cosine] = small_sin_cos(deviation.tilt_rad);
      probe.u_M = cosine * probe.u_M + sine * across(deviation.tilt_turns);
    }
    if (part_[k] != Part::fixture) install(probe, m.part[static_cast<std::size_t>(part_[k])]);
    install(probe, m.part[static_cast<std::size_t>(Part::fixture)]);
    const PlaneDeviation& plane = m.plane[static_cast<std::size_t>(part_[k])];
    probe.n_C = turned_by(plane.turn) * nominal.n_C;
    probe.plane_offset_m = nominal.plane_offset_m * probe.n_C.dot(nominal.n_C);
    for (std::size_t i = 0; i < probe.flatness.height_m.size(); ++i)
      probe.flatness.height_m[i] = nominal.flatness.height_m[i] * plane.map_scale;
  }
  now_ = cold_;
  return displacements(0, {}, zero_m_);
}

// Expands fixture and target about the origin of M.
void MountedFixture::warm(double course) {
  if (mounting_.fixture_expansion == 0 && mounting_.target_expansion == 0) return;
  for (std::size_t k = 0; k < probes(); ++k) {
    now_.probes[k].p_MP = cold_.probes[k].p_MP * (1 + mounting_.fixture_expansion * course);
    now_.probes[k].plane_offset_m =
        cold_.probes[k].plane_offset_m * (1 + mounting_.target_expansion * course);
  }
}

// Random height of the plane at the probe. The place on the plane is calculated to first order in
// the errors. The second order changes the place only by nanometres, and the slopes are below 1e-3.
double MountedFixture::height(std::size_t k, double travel_m, const Errors5& e) const {
  const PlaneDeviation& plane = mounting_.plane[static_cast<std::size_t>(part_[k])];
  if (plane.flatness_m == 0) return 0;
  const Eigen::Vector3d from_C = now_.probes[k].p_MP - Eigen::Vector3d(travel_m, e[kDy], e[kDz]);
  const Eigen::Vector3d c = from_C - Eigen::Vector3d(e[kEx], e[kEy], e[kEz]).cross(from_C);
  const double first = c.x(), second = part_[k] == Part::top ? c.y() : c.z();
  double sum = 0;
  for (std::size_t w = 0; w < kFlatnessWaves; ++w) {
    const double waves =
        (first * plane.along[w] + second * plane.across[w]) * static_cast<double>(w + 1);
    sum += kWaveWeight[w] * sine_of_turns(waves / flatness_length_m_ + plane.phase_turns[w]);
  }
  return plane.flatness_m / 2 * sum;
}

bool MountedFixture::displacements(double travel_m, const Errors5& e, std::span<double> out) {
  if (!within({e[kEx], e[kEy], e[kEz]})) return false;
  if (forward_ == Forward::rigid) {
    const Eigen::VectorXd s = rigid_readings(now_, travel_m, e);
    for (std::size_t k = 0; k < out.size(); ++k) out[k] = s(static_cast<Eigen::Index>(k));
  } else {
    const Eigen::Matrix3d normals = small_angle_normals(e);
    const Eigen::Vector3d t(travel_m, e[kDy], e[kDz]);
    for (std::size_t k = 0; k < out.size(); ++k) {
      const FixtureProbe& probe = now_.probes[k];
      const Eigen::Vector3d n = normals * probe.n_C;
      out[k] = (probe.plane_offset_m - n.dot(probe.p_MP - t)) / n.dot(probe.u_M);
    }
  }
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] += height(k, travel_m, e) / now_.probes[k].n_C.dot(now_.probes[k].u_M);
  return true;
}

bool MountedFixture::read(double travel_m, const Errors5& local, double course, bool zero_at_start,
                          std::span<double> reading_m) {
  warm(course);
  if (!displacements(travel_m, local, reading_m)) return false;
  for (std::size_t k = 0; k < reading_m.size(); ++k) {
    const ProbeDeviation& deviation = mounting_.probe[k];
    // Only the contribution of the mounting is subtracted. The contribution of the rig (height map,
    // offset of a plane) remains, because the solution subtracts it.
    const double zero = zero_at_start ? zero_m_[k] - nominal_zero_m_[k] : 0.0;
    reading_m[k] =
        deviation.gain * (reading_m[k] - zero) + deviation.zero_m + deviation.drift_m * course;
  }
  return true;
}

}  // namespace mdof::algo
