#include "algo/uncertainty/effects/reading_covariance.h"

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include "algo/model/rigid.h"
#include "algo/sensitivity/plan/mounting.h"
#include "algo/uncertainty/effects/expansion_contributors.h"
#include "algo/uncertainty/effects/flatness.h"

namespace mdof::algo {
namespace {

constexpr double kQuarterTurn_turns = 0.25;  // turns

class Covariance {
 public:
  Covariance(const Rig& rig, const Fixture& fixture, double travel_m, const Errors5& carriage)
      : rig_(rig),
        fixture_(fixture),
        travel_m_(travel_m),
        carriage_(carriage),
        sum_(Eigen::MatrixXd::Zero(size(), size())) {}

  // Adds positions, directions and zeros of probes that one calibration determined, with their
  // covariances.
  void add_calibration(const CalibrationCovariance& covariance) {
    together_.insert(covariance.of.begin(), covariance.of.end());
    const auto n = static_cast<Eigen::Index>(covariance.of.size());
    Eigen::MatrixXd change_m = Eigen::MatrixXd::Zero(size(), n);
    Eigen::MatrixXd correlation = Eigen::MatrixXd::Zero(n, n);
    const auto variance = [&](Eigen::Index i, Eigen::Index j) {
      return covariance.m2[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
    };
    for (Eigen::Index i = 0; i < n; ++i) {
      const double u = std::sqrt(variance(i, i));
      if (u > 0) change_m.col(i) = change_by(covariance.of[static_cast<std::size_t>(i)], u);
      for (Eigen::Index j = 0; j < n; ++j)
        if (const double both = u * std::sqrt(variance(j, j)); both > 0)
          correlation(i, j) = variance(i, j) / both;
    }
    sum_ += change_m * correlation * change_m.transpose();
  }
  void add_probe(std::size_t k, double reading_m, double since_zero_s) {
    const ProbeUncertainty& u = rig_.probes[k].uncertainty;
    const std::string& id = rig_.probes[k].id;
    const double u_zero_m = together_.contains(zero_name(id)) ? 0 : u.calibration.u;
    if (std::isfinite(reading_m))
      add_alone(k, std::hypot(u_zero_m, u.sensitivity.u * reading_m,
                              rig_.uncertainty.drift.u * since_zero_s));
    for (std::size_t c = 0; c < 3; ++c)
      if (!together_.contains(place_name(id, c))) add_place(k, c, u.position.u[c]);
    if (together_.contains(direction_name(id, 0)) || together_.contains(direction_name(id, 1)))
      return;
    for (const double turns : {0.0, kQuarterTurn_turns})
      add_mounting(u.direction.u, [&](Mounting& mounting, double size) {
        mounting.probe[k].tilt_rad = size;
        mounting.probe[k].tilt_turns = turns;
      });
  }
  // All probes of the plane measure the same random surface, so their readings are correlated.
  void add_flatness(std::size_t plane) {
    const TargetPlane& surface = rig_.planes[plane];
    if (!surface.u_flatness.declared()) return;
    const FlatnessCovariance heights(surface.u_flatness.u, surface.flatness_length_m);
    const auto footprint = [&](const FixtureProbe& probe) {
      return Footprint{probe.p_MP - travel_m_ * Eigen::Vector3d::UnitX(), probe.p_MP};
    };
    const auto& probes = fixture_.probes;
    for (std::size_t a = 0; a < probes.size(); ++a)
      for (std::size_t b = 0; b < probes.size(); ++b) {
        if (probes[a].plane != plane || probes[b].plane != plane) continue;
        sum_(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) +=
            heights.zeroed_m2(footprint(probes[a]), footprint(probes[b])) /
            (probes[a].n_C.dot(probes[a].u_M) * probes[b].n_C.dot(probes[b].u_M));
      }
  }
  void add_installation() {
    constexpr auto kFixture = static_cast<std::size_t>(Part::fixture);
    for (std::size_t c = 0; c < 3; ++c) {
      add_mounting(rig_.uncertainty.installation_angle.u[c], [&](Mounting& mounting, double size) {
        mounting.part[kFixture].turn = along(c, size);
      });
      add_mounting(rig_.uncertainty.installation_offset.u[c], [&](Mounting& mounting, double size) {
        mounting.part[kFixture].shift = along(c, size);
      });
    }
  }
  void add_expansion() {
    if (const double relative = rig_.expansion.fixture.relative(); relative > 0)
      add_together(readings_by_fixture_expansion(fixture_, relative, travel_m_, carriage_));
    for (const Eigen::Vector3d& bend_per_m : gradient_bends(rig_))
      add_together(readings_by_gradient(fixture_, bend_per_m, travel_m_));
  }
  void add_encoder() {
    const double u_m =
        std::hypot(rig_.uncertainty.encoder.u, rig_.expansion.scale.relative() * travel_m_);
    if (u_m > 0)
      add_together(rigid_readings(fixture_, travel_m_ + u_m, carriage_) -
                   rigid_readings(fixture_, travel_m_, carriage_));
  }
  Eigen::MatrixXd take() { return std::move(sum_); }

 private:
  Eigen::Index size() const { return static_cast<Eigen::Index>(fixture_.probes.size()); }
  Eigen::Vector3d along(std::size_t component, double size) const {
    Vec3 machine{};
    machine[component] = size;
    const Vec3 local = to_local(rig_.axis, machine);
    return {local[0], local[1], local[2]};
  }
  void add_alone(std::size_t k, double u_m) {
    const auto i = static_cast<Eigen::Index>(k);
    sum_(i, i) += u_m * u_m;
  }
  void add_together(const Eigen::VectorXd& change_m) { sum_ += change_m * change_m.transpose(); }

  Eigen::VectorXd readings(const Mounting& mounting) const {
    MountedFixture mounted(fixture_, Forward::rigid, 1);
    Eigen::VectorXd readings_m = Eigen::VectorXd::Zero(size());
    if (mounted.mount(mounting))
      mounted.read(travel_m_, carriage_, 0, true,
                   {readings_m.data(), static_cast<std::size_t>(size())});
    return readings_m;
  }
  // Half the difference of the readings between `set(mounting, u)` and `set(mounting, -u)`.
  template <class Set>
  Eigen::VectorXd change_by_mounting(double u, Set set) const {
    Mounting plus;
    plus.probe.resize(fixture_.probes.size());
    Mounting minus = plus;
    set(plus, u);
    set(minus, -u);
    return (readings(plus) - readings(minus)) / 2;
  }
  template <class Set>
  void add_mounting(double u, Set set) {
    if (u > 0) add_together(change_by_mounting(u, set));
  }
  Eigen::VectorXd change_by_place(std::size_t k, std::size_t axis, double u_m) const {
    return change_by_mounting(
        u_m, [&](Mounting& mounting, double size) { mounting.probe[k].shift = along(axis, size); });
  }
  void add_place(std::size_t k, std::size_t axis, double u_m) {
    if (u_m > 0) add_together(change_by_place(k, axis, u_m));
  }
  // Change of the readings by a change of one component of the probe's direction. The line of the
  // probe turns about the point p_MP.
  Eigen::VectorXd change_by_direction(std::size_t k, std::size_t axis, double u_rad) const {
    const auto zeroed = [&](double by) {
      Fixture turned = fixture_;
      turned.probes[k].u_M = (turned.probes[k].u_M + along(axis, by)).normalized();
      return Eigen::VectorXd(rigid_readings(turned, travel_m_, carriage_) -
                             rigid_readings(turned, 0, Errors5{}));
    };
    return (zeroed(u_rad) - zeroed(-u_rad)) / 2;
  }
  // Change of the readings if a quantity of a calibration changes by `u`.
  Eigen::VectorXd change_by(const std::string& quantity, double u) const {
    for (std::size_t k = 0; k < rig_.probes.size(); ++k) {
      const std::string& id = rig_.probes[k].id;
      if (quantity == zero_name(id))
        return u * Eigen::VectorXd::Unit(size(), static_cast<Eigen::Index>(k));
      for (std::size_t c = 0; c < 3; ++c) {
        if (quantity == place_name(id, c)) return change_by_place(k, c, u);
        if (quantity == direction_name(id, c)) return change_by_direction(k, c, u);
      }
    }
    return Eigen::VectorXd::Zero(size());
  }

  const Rig& rig_;
  const Fixture& fixture_;
  double travel_m_;
  Errors5 carriage_;
  std::set<std::string> together_;  // quantities that a calibration covariance includes
  Eigen::MatrixXd sum_;
};

}  // namespace

Eigen::MatrixXd declared_covariance(const Rig& rig, const Solver& solver, double travel_m,
                                    const Errors5& carriage, const std::vector<double>& readings_m,
                                    double since_zero_s) {
  Covariance covariance(rig, solver.fixture(), travel_m, carriage);
  for (const CalibrationRecord& record : rig.records) covariance.add_calibration(record.covariance);
  for (std::size_t k = 0; k < readings_m.size(); ++k)
    covariance.add_probe(k, readings_m[k], since_zero_s);
  for (std::size_t plane = 0; plane < rig.planes.size(); ++plane) covariance.add_flatness(plane);
  covariance.add_installation();
  covariance.add_expansion();
  covariance.add_encoder();
  return covariance.take();
}

}  // namespace mdof::algo
