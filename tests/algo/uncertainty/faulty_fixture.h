// A fixture with faults that are drawn from the distributions that its rig declares. The code of
// the budgets is not used: the probes of the fixture are moved and turned, and the flatness error
// is a sum of plane waves (drawn_surface.h).
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <vector>

#include "algo/model/fixture.h"
#include "algo/model/rigid.h"
#include "schema/rig/rig.h"
#include "tests/algo/rigs.h"
#include "tests/algo/uncertainty/drawn_surface.h"

namespace mdof::algo::test_faults {

inline constexpr const char* kOfProbes =
    "u_calibration_um = 0.05\nu_sensitivity_ppm = 1500\nu_position_mm = [0.08, 0.08, 0.08]\n"
    "u_direction_mrad = 2\n";

// Adds the declared uncertainties of a probe to each probe in the text of a rig.
inline std::string with_declared_probes(std::string toml) {
  for (std::size_t at = 0; (at = toml.find("measures", at)) != std::string::npos; at += 20) {
    toml.insert(at, kOfProbes);
    at += std::string(kOfProbes).size();
  }
  return toml;
}

// Text that declares the uncertainties of installation, drift and planes. `side_normal`: direction
// of the normal of the side plane.
inline std::string of_rig(double drift_um_per_h, const char* side_normal) {
  return "[installation]\nu_angle_mrad = [2, 2, 2]\nu_offset_mm = [0.05, 0.05, 0.05]\n"
         "[drift]\nu_um_per_h = " +
         std::to_string(drift_um_per_h) +
         "\n[[plane]]\nid = \"top\"\nnormal = \"+Z\"\nu_flatness_um = 0.02\n"
         "[[plane]]\nid = \"side\"\nnormal = \"" +
         side_normal + "\"\nu_flatness_um = 0.02\n";
}

// Mixes the seed before use, because the streams of std::mt19937_64 for neighbouring seeds are
// related: seeds 2 k and 2 k + 1 gave slopes of X and Y with a correlation of -0.3.
inline std::mt19937_64 well_mixed(std::uint64_t seed) {
  std::seed_seq mixed{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)};
  return std::mt19937_64(mixed);
}

class FaultyFixture {
 public:
  // Draws the faults that `rig` declares, all from normal distributions.
  FaultyFixture(const Rig& rig, std::uint64_t seed)
      : rig_(rig),
        nominal_(make_fixture(rig).value()),
        actual_fixture_(nominal_),
        engine_(well_mixed(seed)) {
    apply_mounting_faults();
    zero_ = rigid_readings(actual_fixture_, 0, Errors5{}) - rigid_readings(nominal_, 0, Errors5{});
    for (const Probe& probe : rig.probes) {
      offset_m_.push_back(probe.uncertainty.calibration.u * normal());
      gain_.push_back(probe.uncertainty.sensitivity.u * normal());
      drift_m_per_s_.push_back(rig.uncertainty.drift.u * normal());
    }
    for (const TargetPlane& plane : rig.planes)
      surfaces_.emplace_back(plane.u_flatness.u, plane.flatness_length_m, engine_);
  }

  double normal() { return normal_(engine_); }
  // The scale error of a probe remains when the probe is used in another set-up. take_gains()
  // copies the scale errors from that set-up.
  const std::vector<double>& gains() const { return gain_; }
  void take_gains(const std::vector<double>& gains) { gain_ = gains; }
  // The first plane is the top of the target. It is the same surface for a run along X and a run
  // along Y.
  const DrawnSurface& top() const { return surfaces_.front(); }
  void share_x_top(const DrawnSurface& top) {
    surfaces_.front() = top;
    shares_top_ = true;
  }

  // Readings of all probes without noise, m. `errors`: errors of the carriage in the local frame.
  std::vector<double> readings_m(double d, const Errors5& errors, double time_s) const {
    const Eigen::VectorXd exact = rigid_readings(actual_fixture_, d, errors) - zero_;
    std::vector<double> all;
    for (std::size_t k = 0; k < nominal_.probes.size(); ++k) {
      const FixtureProbe& probe = nominal_.probes[k];
      const double reading = exact(static_cast<Eigen::Index>(k));
      const double second =
          std::abs(probe.n_C.z()) > std::abs(probe.n_C.y()) ? probe.p_MP.y() : probe.p_MP.z();
      const double height_m =
          probe.plane ? above_zero_m(*probe.plane, probe.p_MP.x(), second, d) : 0;
      all.push_back(reading * (1 + gain_[k]) + offset_m_[k] + drift_m_per_s_[k] * time_s +
                    height_m);
    }
    return all;
  }

 private:
  // A run along Y has the local axes x = +Y and y = -X.
  double above_zero_m(std::size_t plane, double first_m, double second_m, double d) const {
    const DrawnSurface& surface = surfaces_[plane];
    if (plane > 0 || !shares_top_) return surface.above_zero_m(first_m, second_m, d);
    return surface.height_m(-second_m, first_m - d) - surface.height_m(-second_m, first_m);
  }
  Eigen::Vector3d vector(double u) { return {u * normal(), u * normal(), u * normal()}; }

  void apply_mounting_faults() {
    const RigUncertainty& whole = rig_.uncertainty;
    const Eigen::Vector3d turn = vector(whole.installation_angle.u[0]);
    const Eigen::Vector3d shift = vector(whole.installation_offset.u[0]);
    for (std::size_t k = 0; k < actual_fixture_.probes.size(); ++k) {
      FixtureProbe& probe = actual_fixture_.probes[k];
      const ProbeUncertainty& u = rig_.probes[k].uncertainty;
      probe.p_MP += vector(u.position.u[0]);
      const Eigen::Vector3d tilt = vector(u.direction.u);
      probe.u_M = (probe.u_M + tilt.cross(probe.u_M)).normalized();
      if (turn.norm() == 0) continue;
      const Eigen::AngleAxisd all(turn.norm(), turn.normalized());
      probe.p_MP = all * probe.p_MP + shift;
      probe.u_M = all * probe.u_M;
    }
  }

  const Rig& rig_;
  Fixture nominal_, actual_fixture_;
  Eigen::VectorXd zero_;
  std::mt19937_64 engine_;
  std::normal_distribution<> normal_;
  std::vector<double> offset_m_, gain_, drift_m_per_s_;
  std::vector<DrawnSurface> surfaces_;
  bool shares_top_ = false;
};

// True errors of the carriage in the local frame, at a travel of d metres.
inline Errors5 true_errors(double d) {
  return {1.5e-6 * std::sin(90 * d) + 8e-6 * d, 1e-6 * std::cos(110 * d) - 5e-4 * d,
          40e-6 * std::sin(60 * d), 60e-6 * std::cos(50 * d), 80e-6 * std::sin(70 * d)};
}

}  // namespace mdof::algo::test_faults
