#include "algo/uncertainty/effects/reading_covariance.h"

#include <cmath>
#include <cstddef>
#include <utility>

#include "algo/model/rigid.h"
#include "algo/sensitivity/plan/mounting.h"
#include "algo/uncertainty/effects/expansion_contributors.h"

namespace mdof::algo {
namespace {

constexpr double kAQuarter = 0.25;  // of a turn

class Covariance {
 public:
  Covariance(const Rig& rig, const Fixture& fixture, double travel_m, const Errors5& carriage)
      : rig_(rig),
        fixture_(fixture),
        travel_m_(travel_m),
        carriage_(carriage),
        sum_(Eigen::MatrixXd::Zero(size(), size())) {}

  void add_probe(std::size_t k, double reading_m, double since_zero_s) {
    const ProbeUncertainty& u = rig_.probes[k].uncertainty;
    if (std::isfinite(reading_m))
      add_alone(k, std::hypot(u.calibration.u, u.sensitivity.u * reading_m,
                              rig_.uncertainty.drift.u * since_zero_s));
    if (const auto plane = fixture_.probes[k].plane) add_alone(k, rig_.planes[*plane].u_flatness.u);
    for (std::size_t c = 0; c < 3; ++c)
      add_mounting(u.position.u[c], [&](Mounting& mounting, double size) {
        mounting.probe[k].shift = along(c, size);
      });
    for (const double turns : {0.0, kAQuarter})
      add_mounting(u.direction.u, [&](Mounting& mounting, double size) {
        mounting.probe[k].tilt_rad = size;
        mounting.probe[k].tilt_turns = turns;
      });
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
  // `set(mounting, u)`; half of what the readings differ by between u and -u.
  template <class Set>
  void add_mounting(double u, Set set) {
    if (!(u > 0)) return;
    Mounting plus;
    plus.probe.resize(fixture_.probes.size());
    Mounting minus = plus;
    set(plus, u);
    set(minus, -u);
    add_together((readings(plus) - readings(minus)) / 2);
  }

  const Rig& rig_;
  const Fixture& fixture_;
  double travel_m_;
  Errors5 carriage_;
  Eigen::MatrixXd sum_;
};

}  // namespace

Eigen::MatrixXd declared_covariance(const Rig& rig, const Solver& solver, double travel_m,
                                    const Errors5& carriage, const std::vector<double>& readings_m,
                                    double since_zero_s) {
  Covariance covariance(rig, solver.fixture(), travel_m, carriage);
  for (std::size_t k = 0; k < readings_m.size(); ++k)
    covariance.add_probe(k, readings_m[k], since_zero_s);
  covariance.add_installation();
  covariance.add_expansion();
  covariance.add_encoder();
  return covariance.take();
}

}  // namespace mdof::algo
