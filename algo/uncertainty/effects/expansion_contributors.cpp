#include "algo/uncertainty/effects/expansion_contributors.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "algo/model/rigid.h"

namespace mdof::algo {
namespace {

constexpr const char* kScaleKey = "[temperature] u_scale_K";
constexpr const char* kFixtureKey = "[temperature] u_fixture_K";
constexpr const char* kGradientKey = "[temperature] u_square_gradient_K_per_m";

Fixture expanded(Fixture fixture, double relative) {
  for (FixtureProbe& probe : fixture.probes) probe.p_MP *= 1 + relative;
  return fixture;
}

// Displacement along `normal` of the point of the target at `place`.
double moved_along(const Eigen::Vector3d& normal, const Eigen::Vector3d& bend_per_m,
                   const Eigen::Vector3d& place) {
  return bend_per_m.dot(place) * normal.dot(place) -
         place.squaredNorm() * normal.dot(bend_per_m) / 2;
}

// Changes of the errors of all points. `readings_at(travel, carriage)` returns the changes of all
// readings.
template <class Readings>
PointShifts by_readings(const std::vector<PointSensitivity>& points, Readings readings_at) {
  PointShifts shifts(points.size());
  for (std::size_t j = 0; j < points.size(); ++j) {
    if (!points[j].valid) continue;
    const Eigen::VectorXd change_m = readings_at(points[j].travel_m, points[j].carriage);
    for (std::size_t k = 0; k < points[j].by_probe.size(); ++k)
      for (std::size_t e = 0; e < kErrorCount; ++e)
        shifts[j][e] += points[j].by_probe[k][e] * change_m(static_cast<Eigen::Index>(k));
  }
  return shifts;
}

Contributor contributor(ContributorKind kind, const char* key, const DeclaredUncertainty& declared,
                        double to_unit, const char* unit, std::vector<PointShifts> parts) {
  return {{kind}, key, declared, to_unit, unit, [parts = std::move(parts)] { return parts; }};
}

// The value in the line of the budget is the relative expansion.
DeclaredUncertainty relative_of(const BodyExpansion& body) {
  return {body.relative(), body.u_temperature.shape, body.u_temperature.freedom};
}

}  // namespace

Eigen::VectorXd readings_by_fixture_expansion(const Fixture& fixture, double relative,
                                              double travel_m, const Errors5& carriage) {
  const Fixture larger = expanded(fixture, relative), smaller = expanded(fixture, -relative);
  const auto difference = [&](double at_m, const Errors5& errors) -> Eigen::VectorXd {
    return (rigid_readings(larger, at_m, errors) - rigid_readings(smaller, at_m, errors)) / 2;
  };
  return difference(travel_m, carriage) - difference(0, Errors5{});
}

Eigen::VectorXd readings_by_gradient(const Fixture& fixture, const Eigen::Vector3d& bend_per_m,
                                     double travel_m) {
  Eigen::VectorXd change_m(static_cast<Eigen::Index>(fixture.probes.size()));
  for (std::size_t k = 0; k < fixture.probes.size(); ++k) {
    const FixtureProbe& probe = fixture.probes[k];
    const Eigen::Vector3d at_zero = probe.p_MP, now = at_zero - travel_m * Eigen::Vector3d::UnitX();
    const double height_m =
        moved_along(probe.n_C, bend_per_m, now) - moved_along(probe.n_C, bend_per_m, at_zero);
    change_m(static_cast<Eigen::Index>(k)) = height_m / probe.n_C.dot(probe.u_M);
  }
  return change_m;
}

std::vector<Eigen::Vector3d> gradient_bends(const Rig& rig) {
  std::vector<Eigen::Vector3d> bends;
  const double per_K = std::sqrt(rig.expansion.square.mean_square_per_K2());
  for (std::size_t c = 0; c < 3; ++c) {
    Vec3 machine{};
    machine[c] = per_K * rig.expansion.square_gradient.u[c];
    const Vec3 local = to_local(rig.axis, machine);
    if (machine[c] > 0) bends.emplace_back(local[0], local[1], local[2]);
  }
  return bends;
}

std::vector<Contributor> expansion_contributors(const Rig& rig, const Solver& solver,
                                                const std::vector<PointSensitivity>& points) {
  std::vector<Contributor> list;
  const RigExpansion& rig_expansion = rig.expansion;
  if (const double scale = rig_expansion.scale.relative(); scale > 0) {
    // If the scale is longer, it shows a smaller position than the true position.
    PointShifts shifts(points.size());
    for (std::size_t j = 0; j < points.size(); ++j)
      for (std::size_t e = 0; e < kErrorCount; ++e)
        shifts[j][e] = -scale * points[j].travel_m * points[j].by_place[e];
    list.push_back(contributor(ContributorKind::scale_expansion, kScaleKey,
                               relative_of(rig_expansion.scale), 1e6, "ppm", {std::move(shifts)}));
  }
  const Fixture& fixture = solver.fixture();
  if (const double relative = rig_expansion.fixture.relative(); relative > 0)
    list.push_back(contributor(
        ContributorKind::fixture_expansion, kFixtureKey, relative_of(rig_expansion.fixture), 1e6,
        "ppm", {by_readings(points, [&](double travel_m, const Errors5& carriage) {
          return readings_by_fixture_expansion(fixture, relative, travel_m, carriage);
        })}));
  std::vector<PointShifts> bent;
  for (const Eigen::Vector3d& bend_per_m : gradient_bends(rig))
    bent.push_back(by_readings(points, [&](double travel_m, const Errors5&) {
      return readings_by_gradient(fixture, bend_per_m, travel_m);
    }));
  if (bent.empty()) return list;
  const DeclaredUncertainty3& of = rig_expansion.square_gradient;
  DeclaredUncertainty largest{0, of.shape, of.freedom};
  for (const double u : of.u) largest.u = std::max(largest.u, u);
  list.push_back(contributor(ContributorKind::square_gradient, kGradientKey, largest, 1, "K/m",
                             std::move(bent)));
  return list;
}

}  // namespace mdof::algo
