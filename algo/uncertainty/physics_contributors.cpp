#include "algo/uncertainty/physics_contributors.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "algo/model/small_rotation.h"
#include "algo/probe_physics/air.h"
#include "algo/probe_physics/gap.h"
#include "algo/sensitivity/plan/draws.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

// Gap and tilt of one probe at one point.
struct Gap {
  double gap_m = 0;
  Eigen::Vector3d tilt = Eigen::Vector3d::Zero();  // tilt_of()
};

class Physics {
 public:
  Physics(const Rig& rig, const Solver& solver, const Run& run,
          const std::vector<PointSensitivity>& points)
      : rig_(rig), fixture_(solver.fixture()), run_(run), points_(points) {
    for (std::size_t k = 0; k < rig.probes.size(); ++k) add_probe(k);
    add_air();
  }
  std::vector<Contributor> take() { return std::move(list_); }

 private:
  const RigPhysics& physics() const { return *rig_.physics; }

  // Changes of the errors of all points. `change_m(point, probe)` returns the change of one reading
  // by one standard uncertainty, m.
  template <class Change>
  PointShifts shifts(Change change_m) const {
    PointShifts all(points_.size());
    for (std::size_t j = 0; j < all.size(); ++j) {
      if (!points_[j].valid) continue;
      for (std::size_t k = 0; k < rig_.probes.size(); ++k) {
        const Errors5& by_probe = points_[j].by_probe[k];
        if (by_probe == Errors5{}) continue;
        const double change = change_m(j, k);
        for (std::size_t e = 0; e < kErrorCount; ++e)
          if (by_probe[e] != 0) all[j][e] += by_probe[e] * change;
      }
    }
    return all;
  }
  template <class Change>
  PointShifts of_probe(std::size_t probe, Change change_m) const {
    return shifts([&](std::size_t j, std::size_t k) { return k == probe ? change_m(j) : 0.0; });
  }

  // Adds a contributor if its uncertainty is declared. `parts` are calculated in advance, because
  // they are few and need common results that take long to calculate.
  void add(ContributorName name, std::string key, const DeclaredUncertainty& declared,
           double to_unit, std::string unit, std::vector<PointShifts> parts) {
    if (!declared.declared()) return;
    list_.push_back({std::move(name), std::move(key), declared, to_unit, std::move(unit),
                     [parts = std::move(parts)] { return parts; }});
  }

  Gap at(std::size_t j, std::size_t k) const {
    const auto R_MC = local_rotation(fixture_.axis, points_[j].carriage).R_MC;
    return {physics().probes[k].standoff_m - run_.points[j].point.probe_m[k],
            tilt_of(fixture_.probes[k], R_MC)};
  }

  ContributorName named(ContributorKind kind, std::size_t k) const {
    return {kind, rig_.probes[k].id};
  }

  void add_probe(std::size_t k) {
    if (physics().probes[k].tilts()) {
      add_tilt(k);
      add_clamp(k);
    }
    add_linearity(k);
    add_left_out(k);
  }

  // Adds the effect of the tilt factor on the reading, minus its effect where the probe was zeroed.
  // If the tilt is corrected, the uncertainty is u of the factor. If the tilt is not corrected, the
  // uncertainty is the root of factor² + u².
  void add_tilt(std::size_t k) {
    const ProbePhysics& probe = physics().probes[k];
    DeclaredUncertainty factor = probe.u_tilt_factor;
    if (!physics().tilt)
      factor = {std::sqrt(probe.tilt_factor * probe.tilt_factor +
                          probe.u_tilt_factor.u * probe.u_tilt_factor.u)};
    ProbePhysics unit = probe;
    unit.tilt_factor = 1;
    const double zero =
        tilt_of(fixture_.probes[k], Eigen::Matrix3d::Identity()).squaredNorm() / probe.standoff_m;
    add(named(physics().tilt ? ContributorKind::probe_tilt : ContributorKind::probe_tilt_left, k),
        physics().tilt ? "u_tilt_factor" : "tilt_factor", factor, 1, "", {of_probe(k, [&](auto j) {
          const Gap gap = at(j, k);
          return factor.u *
                 gap_decrease_by_tilt_m(unit, gap.tilt.squaredNorm() - zero * gap.gap_m, gap.gap_m);
        })});
  }

  // Adds the effect of an unknown tilt φ of the probe in its clamp. With the tilt θ of the target,
  // the reading depends on |θ + φ|² = θ² + 2 θ·φ + φ². The product has two parts, for φ about two
  // axes. φ² is a third part, because its effect depends on the gap.
  void add_clamp(std::size_t k) {
    const ProbePhysics& probe = physics().probes[k];
    const DeclaredUncertainty& u = rig_.probes[k].uncertainty.direction;
    const Gap zero{probe.standoff_m, tilt_of(fixture_.probes[k], Eigen::Matrix3d::Identity())};
    const Eigen::Vector3d first = fixture_.probes[k].u_M.unitOrthogonal();
    const Eigen::Vector3d second = fixture_.probes[k].u_M.cross(first);
    std::vector<PointShifts> parts;
    for (const Eigen::Vector3d& about : {first, second})
      parts.push_back(of_probe(k, [&](std::size_t j) {
        const Gap gap = at(j, k);
        return gap_decrease_by_tilt_m(probe, 2 * u.u * about.dot(gap.tilt), gap.gap_m) -
               gap_decrease_by_tilt_m(probe, 2 * u.u * about.dot(zero.tilt), zero.gap_m);
      }));
    parts.push_back(of_probe(k, [&](std::size_t j) {
      const double square = 2 * u.u * u.u;
      return gap_decrease_by_tilt_m(probe, square, at(j, k).gap_m) -
             gap_decrease_by_tilt_m(probe, square, zero.gap_m);
    }));
    add(named(ContributorKind::probe_clamp, k), "u_direction_mrad", u, 1e3, "mrad",
        std::move(parts));
  }

  // Adds the linearity error that remains after the correction, as waves over the range of the
  // probe. The sum of the squares of the waves is u² at every reading.
  void add_linearity(std::size_t k) {
    const DeclaredUncertainty& u = physics().probes[k].u_linearity;
    std::vector<PointShifts> parts;
    double norm = 0;
    for (std::size_t w = 1; w <= kFlatnessWaves; ++w) norm += std::pow(static_cast<double>(w), -4);
    for (std::size_t w = 1; u.declared() && w <= kFlatnessWaves; ++w)
      for (const double phase_turns : {0.0, 0.25})
        parts.push_back(of_probe(k, [&](std::size_t j) {
          const auto wave = static_cast<double>(w);
          const double turns = run_.points[j].point.probe_m[k] / rig_.probes[k].range_m * wave;
          return u.u / (wave * wave * std::sqrt(norm)) * sine_of_turns(turns + phase_turns);
        }));
    add(named(ContributorKind::probe_linearity, k), "u_linearity_um", u, 1e6, "µm",
        std::move(parts));
  }

  // Adds the linearity correction that is omitted if the rig has linearity = false.
  void add_left_out(std::size_t k) {
    if (physics().left_out.empty()) return;
    const Calibration& c = *physics().left_out[k];
    double most_m = 0;
    const auto correction_m = [&](std::size_t j) {
      const double sign = c.reads_gap ? -1 : 1;
      return sign * from_um(linearity_um(c, sign * to_um(run_.points[j].point.probe_m[k])));
    };
    for (std::size_t j = 0; j < points_.size(); ++j)
      if (points_[j].valid) most_m = std::max(most_m, std::abs(correction_m(j)));
    add(named(ContributorKind::probe_linearity_left, k),
        c.polynomial_um.empty() ? "linearity" : "polynomial_um", {most_m}, 1e6, "µm",
        {of_probe(k, correction_m)});
  }

  // Changes of the errors by a relative change `u` of the permittivity. The change of a reading is
  // proportional to the gap.
  std::vector<PointShifts> by_permittivity(double u) const {
    return {shifts([&](std::size_t j, std::size_t k) { return -u * at(j, k).gap_m; })};
  }

  void add_air() {
    if (!physics().has_known_air_effect()) return;
    const DeclaredAir& air = *physics().air;
    const double calibration = air_permittivity(air.calibration);
    // If the rig does not contain an ambient condition of the run, the condition of the calibration
    // is used instead. The slopes at both conditions agree to 1 %.
    Air run = air.calibration;
    bool known = true;
    for (std::size_t q = 0; q < kAirQuantities; ++q) {
      known = known && air.run[q];
      run[q] = air.run[q].value_or(run[q]);
    }
    if (!physics().dielectric && known) {
      const double ratio = air_permittivity(run) / calibration - 1;
      add({ContributorKind::air_dielectric_left}, "[air]", {std::abs(ratio)}, 1e6, "ppm",
          by_permittivity(ratio));
    }
    for (std::size_t q = 0; q < kAirQuantities; ++q) {
      const AirQuantity& of = air_quantities()[q];
      const DeclaredUncertainty &u = air.u_run[q], &u_calibration = air.u_calibration[q];
      add({of_component(ContributorKind::air_temperature, q)}, std::string("u_") + of.key, u, 1,
          of.unit, by_permittivity(u.u * air_permittivity_slope(run, q)));
      add({of_component(ContributorKind::calibration_air_temperature, q)},
          std::string("u_calibration_") + of.key, u_calibration, 1, of.unit,
          by_permittivity(-u_calibration.u * air_permittivity_slope(air.calibration, q)));
    }
  }

  const Rig& rig_;
  const Fixture& fixture_;
  const Run& run_;
  const std::vector<PointSensitivity>& points_;
  std::vector<Contributor> list_;
};

}  // namespace

std::vector<Contributor> physics_contributors(const Rig& rig, const Solver& solver, const Run& run,
                                              const std::vector<PointSensitivity>& points) {
  if (!rig.physics) return {};
  return Physics(rig, solver, run, points).take();
}

}  // namespace mdof::algo
