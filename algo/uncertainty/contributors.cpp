#include "algo/uncertainty/contributors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <utility>

#include "algo/drift/removed_drift.h"
#include "algo/model/restate.h"
#include "algo/model/rigid.h"
#include "algo/model/small_rotation.h"
#include "algo/model/solver.h"
#include "algo/sensitivity/plan/mounting.h"
#include "algo/uncertainty/effects/expansion_contributors.h"
#include "algo/uncertainty/effects/flatness.h"
#include "algo/uncertainty/effects/model_contributor.h"
#include "algo/uncertainty/effects/plane_footprints.h"
#include "algo/uncertainty/physics_contributors.h"
#include "algo/uncertainty/point_sensitivity.h"
#include "algo/uncertainty/statistics/common_quantities.h"
#include "algo/uncertainty/statistics/independent_parts.h"
#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kMostEncoderParts = 256;  // if there are more targets, several neighbouring
                                                // targets have one part
constexpr auto kFixture = static_cast<std::size_t>(Part::fixture);
constexpr double kQuarterTurn = 0.25;  // turns; azimuth of the second direction of a tilt

// Data that all contributors of a run need.
struct Basis {
  Rig rig;
  Solver solver;
  Run run;
  std::vector<PointSensitivity> points;

  std::size_t probes() const { return rig.probes.size(); }
  Eigen::Vector3d local(const Vec3& machine) const {
    const Vec3 l = to_local(rig.axis, machine);
    return {l[0], l[1], l[2]};
  }
};
using SharedBasis = std::shared_ptr<const Basis>;

Vec3 along_axis(std::size_t component, double value) {
  Vec3 v{};
  v[component] = value;
  return v;
}

// Changes of the errors by changes of the readings. `change_m(point, probe)` returns the change of
// one reading, m.
template <class Change>
PointShifts by_readings(const Basis& basis, std::size_t first_probe, std::size_t end_probe,
                        Change change_m) {
  PointShifts shifts(basis.points.size());
  for (std::size_t j = 0; j < shifts.size(); ++j) {
    const PointSensitivity& point = basis.points[j];
    if (!point.valid) continue;
    for (std::size_t k = first_probe; k < end_probe; ++k) {
      const Errors5& by_probe = point.by_probe[k];
      if (by_probe == Errors5{}) continue;
      const double change = change_m(j, k);
      for (std::size_t e = 0; e < kErrorCount; ++e)
        if (by_probe[e] != 0) shifts[j][e] += by_probe[e] * change;
    }
  }
  return shifts;
}

template <class Change>
PointShifts by_all_probes(const Basis& basis, Change change_m) {
  return by_readings(basis, 0, basis.probes(), change_m);
}

template <class Change>
PointShifts by_one_probe(const Basis& basis, std::size_t probe, Change change_m) {
  return by_readings(basis, probe, probe + 1,
                     [&](std::size_t j, std::size_t) { return change_m(j); });
}

// Readings of all probes of `nominal` at every point with the deviations `mounting`. Empty if an
// angle is too large.
std::vector<double> readings_of(const Basis& basis, const Fixture& nominal,
                                const Mounting& mounting) {
  const Forward forward =
      basis.solver.model() == Model::rigid ? Forward::rigid : Forward::small_angle;
  MountedFixture fixture(nominal, forward, 1);
  if (!fixture.mount(mounting)) return {};
  const std::size_t probes = nominal.probes.size();
  std::vector<double> readings(basis.points.size() * probes);
  for (std::size_t j = 0; j < basis.points.size(); ++j) {
    const PointSensitivity& point = basis.points[j];
    const std::span<double> here(readings.data() + j * probes, probes);
    if (point.valid && !fixture.read(point.travel_m, point.carriage, 0, true, here)) return {};
  }
  return readings;
}

// Half the difference of the readings between `set(mounting, +1)` and `set(mounting, -1)`, for each
// probe of `fixture` at each point.
template <class Set>
std::vector<double> by_mounting(const Basis& basis, const Fixture& fixture, Set set) {
  Mounting plus;
  plus.probe.resize(fixture.probes.size());
  Mounting minus = plus;
  set(plus, 1.0);
  set(minus, -1.0);
  std::vector<double> half = readings_of(basis, fixture, plus);
  const std::vector<double> below = readings_of(basis, fixture, minus);
  for (std::size_t i = 0; i < half.size(); ++i) half[i] = (half[i] - below[i]) / 2;
  return half;
}

template <class Set>
PointShifts by_mounting(const Basis& basis, Set set) {
  const std::vector<double> change = by_mounting(basis, basis.solver.fixture(), set);
  return by_all_probes(
      basis, [&](std::size_t j, std::size_t k) { return change[j * basis.probes() + k]; });
}

// Changes of the errors by the deviation of one probe. `set(deviation, ±1)` sets this deviation.
// The readings of the other probes do not change.
template <class Set>
PointShifts by_probe_mounting(const Basis& basis, std::size_t probe, Set set) {
  const Fixture& all = basis.solver.fixture();
  const Fixture alone{all.axis, {all.probes[probe]}};
  const std::vector<double> change = by_mounting(
      basis, alone, [&](Mounting& mounting, double sign) { set(mounting.probe[0], sign); });
  return by_one_probe(basis, probe, [&](std::size_t j) { return change[j]; });
}

double middle_s(const MeasuredPoint& p) {
  return (ns_to_s(p.point.begin_ns) + ns_to_s(p.point.end_ns)) / 2;
}

std::vector<PointShifts> of_encoder(const Basis& basis) {
  std::map<int, std::size_t> part_of;  // number of the part for each target
  for (const auto& p : basis.run.points) part_of.emplace(p.target, 0);
  const std::size_t each = (part_of.size() + kMostEncoderParts - 1) / kMostEncoderParts;
  std::size_t n = 0;
  for (auto& [target, part] : part_of) part = n++ / each;
  std::vector<PointShifts> parts((n + each - 1) / each, PointShifts(basis.points.size()));
  const double u = basis.rig.uncertainty.encoder.u;
  for (std::size_t j = 0; j < basis.points.size(); ++j)
    for (std::size_t e = 0; e < kErrorCount; ++e)
      parts[part_of[basis.run.points[j].target]][j][e] = u * basis.points[j].by_place[e];
  return parts;
}

PointShifts calibration_shifts(const Basis& basis, std::size_t probe, double size_m) {
  return by_one_probe(basis, probe, [&](std::size_t) { return size_m; });
}

PointShifts of_position(const Basis& basis, std::size_t probe, std::size_t axis, double size_m) {
  return by_probe_mounting(basis, probe, [&](ProbeDeviation& off, double sign) {
    off.shift = basis.local(along_axis(axis, sign * size_m));
  });
}

// Changes of the errors by a change of one component of the probe's direction (axes of the
// machine). The line of the probe turns about the point p_MP.
PointShifts of_direction(const Basis& basis, std::size_t probe, std::size_t axis, double size_rad) {
  const FixtureProbe& nominal = basis.solver.fixture().probes[probe];
  const Eigen::Vector3d change = basis.local(along_axis(axis, size_rad));
  const auto zeroed = [&](const Eigen::Vector3d& u_M, const PointSensitivity& point) {
    Fixture turned{basis.rig.axis, {nominal}};
    turned.probes[0].u_M = u_M.normalized();
    return rigid_readings(turned, point.travel_m, point.carriage)(0) -
           rigid_readings(turned, 0, Errors5{})(0);
  };
  return by_one_probe(basis, probe, [&](std::size_t j) {
    const PointSensitivity& point = basis.points[j];
    return (zeroed(nominal.u_M + change, point) - zeroed(nominal.u_M - change, point)) / 2;
  });
}

// Changes of the errors by positions, directions and zeros of probes that one calibration
// determined, as independent parts.
std::vector<PointShifts> covariance_shifts(const Basis& basis,
                                           const CalibrationCovariance& covariance) {
  std::vector<PointShifts> alone;  // by one standard uncertainty of each quantity
  std::vector<double> u_m;
  for (std::size_t i = 0; i < covariance.of.size(); ++i) {
    u_m.push_back(std::sqrt(covariance.m2[i][i]));
    PointShifts& shifts = alone.emplace_back(basis.points.size());
    for (std::size_t k = 0; k < basis.probes() && u_m[i] > 0; ++k) {
      const std::string& id = basis.rig.probes[k].id;
      if (covariance.of[i] == zero_name(id)) shifts = calibration_shifts(basis, k, u_m[i]);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (covariance.of[i] == place_name(id, axis)) shifts = of_position(basis, k, axis, u_m[i]);
        if (covariance.of[i] == direction_name(id, axis))
          shifts = of_direction(basis, k, axis, u_m[i]);
      }
    }
  }
  const auto correlation = [&](std::size_t i, std::size_t j) {
    return u_m[i] > 0 && u_m[j] > 0 ? covariance.m2[i][j] / (u_m[i] * u_m[j]) : 0.0;
  };
  return combined(independent_parts(alone.size(), correlation, alone.size()), alone);
}

class List {
 public:
  explicit List(SharedBasis basis) : basis_(std::move(basis)) {
    for (const CalibrationRecord& record : basis_->rig.records) add_covariance(record);
    for (std::size_t k = 0; k < basis_->probes(); ++k) add_probe(k);
    add_installation();
    add_drift();
    for (std::size_t i = 0; i < basis_->rig.planes.size(); ++i) add_plane(i);
    add({ContributorKind::encoder}, "u_um", basis_->rig.uncertainty.encoder, 1e6, "µm",
        [](const Basis& b) { return of_encoder(b); });
  }
  std::vector<Contributor> take() { return std::move(list_); }

 private:
  // Adds a contributor if its uncertainty is declared. `parts(basis)` returns Contributor::parts.
  template <class Parts>
  void add(ContributorName name, std::string key, const DeclaredUncertainty& declared,
           double to_unit, std::string unit, Parts parts) {
    if (!declared.declared()) return;
    list_.push_back({std::move(name), std::move(key), declared, to_unit, std::move(unit),
                     [basis = basis_, parts] { return parts(*basis); }});
  }

  // The value in the line of the budget is the largest standard uncertainty of the quantities of
  // the record that are lengths.
  void add_covariance(const CalibrationRecord& record) {
    const CalibrationCovariance& covariance = record.covariance;
    DeclaredUncertainty largest;
    for (std::size_t i = 0; i < covariance.of.size(); ++i)
      if (covariance.of[i].find(".n") == std::string::npos)
        largest.u = std::max(largest.u, std::sqrt(covariance.m2[i][i]));
    together_.insert(covariance.of.begin(), covariance.of.end());
    add({ContributorKind::calibration_record, record.id}, "calibration", largest, 1e6, "µm",
        [covariance](const Basis& b) { return covariance_shifts(b, covariance); });
  }

  void add_probe(std::size_t k) {
    const Probe& probe = basis_->rig.probes[k];
    const auto of_probe = [&](ContributorKind kind) { return ContributorName{kind, probe.id}; };
    const ProbeUncertainty& u = probe.uncertainty;
    if (!together_.contains(zero_name(probe.id)))
      add(of_probe(ContributorKind::probe_calibration), "u_calibration_um", u.calibration, 1e6,
          "µm", [k, size = u.calibration.u](const Basis& b) {
            return std::vector<PointShifts>{calibration_shifts(b, k, size)};
          });
    add(of_probe(ContributorKind::probe_sensitivity), "u_sensitivity_ppm", u.sensitivity, 1e6,
        "ppm", [k, size = u.sensitivity.u](const Basis& b) {
          return std::vector<PointShifts>{by_one_probe(
              b, k, [&](std::size_t j) { return size * b.run.points[j].point.probe_m[k]; })};
        });
    for (std::size_t c = 0; c < 3; ++c) {
      if (together_.contains(place_name(probe.id, c))) continue;
      add(of_probe(of_component(ContributorKind::probe_position_x, c)), "u_position_mm",
          u.position.component(c), 1e3, "mm", [k, c, size = u.position.u[c]](const Basis& b) {
            return std::vector<PointShifts>{of_position(b, k, c, size)};
          });
    }
    if (together_.contains(direction_name(probe.id, 0)) ||
        together_.contains(direction_name(probe.id, 1)))
      return;
    add(of_probe(ContributorKind::probe_direction), "u_direction_mrad", u.direction, 1e3, "mrad",
        [k, size = u.direction.u](const Basis& b) {
          const auto about = [&](double turns) {
            return by_probe_mounting(b, k, [&](ProbeDeviation& probe_off, double sign) {
              probe_off.tilt_rad = sign * size;
              probe_off.tilt_turns = turns;
            });
          };
          // A probe that is turned by an angle reads 1/cos of the displacement. Root mean square of
          // this relative change for angles about two axes.
          const double cosine = std::sqrt(2.0) * size * size;
          return std::vector<PointShifts>{about(0), about(kQuarterTurn),
                                          by_one_probe(b, k, [&](std::size_t j) {
                                            return cosine * b.run.points[j].point.probe_m[k];
                                          })};
        });
  }

  void add_installation() {
    const RigUncertainty& u = basis_->rig.uncertainty;
    for (std::size_t c = 0; c < 3; ++c)
      add({of_component(ContributorKind::installation_angle_x, c)}, "u_angle_mrad",
          u.installation_angle.component(c), 1e3, "mrad",
          [c, size = u.installation_angle.u[c]](const Basis& b) {
            return std::vector<PointShifts>{by_mounting(b, [&](Mounting& mounting, double sign) {
              mounting.part[kFixture].turn = b.local(along_axis(c, sign * size));
            })};
          });
    for (std::size_t c = 0; c < 3; ++c)
      add({of_component(ContributorKind::installation_offset_x, c)}, "u_offset_mm",
          u.installation_offset.component(c), 1e3, "mm",
          [c, size = u.installation_offset.u[c]](const Basis& b) {
            return std::vector<PointShifts>{by_mounting(b, [&](Mounting& mounting, double sign) {
              mounting.part[kFixture].shift = b.local(along_axis(c, sign * size));
            })};
          });
  }

  // The drift is 0 at the first point of the run.
  void add_drift() {
    const DeclaredUncertainty& u = basis_->rig.uncertainty.drift;
    for (std::size_t k = 0; k < basis_->probes(); ++k)
      add({ContributorKind::probe_drift, basis_->rig.probes[k].id}, "u_um_per_h", u, 3600e6, "µm/h",
          [k, size = u.u](const Basis& b) {
            const double start_s = middle_s(b.run.points.front());
            return std::vector<PointShifts>{by_one_probe(
                b, k, [&](std::size_t j) { return size * (middle_s(b.run.points[j]) - start_s); })};
          });
  }

  void add_plane(std::size_t i) {
    const TargetPlane& plane = basis_->rig.planes[i];
    const std::size_t before = list_.size();
    add(flatness_name(basis_->rig, plane), "u_flatness_um", plane.u_flatness, 1e6, "µm",
        [](const Basis&) { return std::vector<PointShifts>(); });
    if (list_.size() == before) return;
    list_.back().surface = std::make_shared<const PlaneFootprints>(
        plane_footprints(basis_->rig, basis_->solver.fixture(), basis_->run, basis_->points, i));
    list_.back().parts = [surface = list_.back().surface] {
      return flatness_parts({surface.get()}).front();
    };
  }

  SharedBasis basis_;
  std::set<std::string> together_;  // quantities that a calibration covariance includes
  std::vector<Contributor> list_;
};

bool is_small(const Errors5& e) {
  const double most = std::max({std::abs(e[kEx]), std::abs(e[kEy]), std::abs(e[kEz])});
  return most < kSmallAngleMax_rad;
}

std::string name_of(const Run& run) {
  return "run " + std::to_string(run.header.id);
}

// Error: an angle of the run is beyond the limit of MountedFixture.
Status check_run(const Basis& basis) {
  const std::string run = name_of(basis.run);
  for (std::size_t j = 0; j < basis.points.size(); ++j)
    if (basis.points[j].valid && !is_small(basis.points[j].carriage))
      return bad_input(run + ": at target " + std::to_string(basis.run.points[j].target) +
                       " an angle exceeds 250 mrad, the limit of the mounting model, so no budget "
                       "can be calculated; check positions, directions and units in the rig");
  return {};
}

Status check_angles(const Rig& rig) {
  const auto fits = [](double u_rad) { return u_rad <= kSmallAngleMax_rad / 2; };
  bool small = true;
  for (const Probe& probe : rig.probes) small = small && fits(probe.uncertainty.direction.u);
  for (const double u : rig.uncertainty.installation_angle.u) small = small && fits(u);
  if (small) return {};
  return bad_input(rig.source +
                   ": a declared u_direction_mrad or u_angle_mrad exceeds 125 mrad, the limit of "
                   "the model; check that the value is in mrad");
}

}  // namespace

Result<std::vector<Contributor>> contributors(const Rig& rig, const Run& run) {
  if (run.points.empty())
    return bad_input(name_of(run) + " has no points, so no budget can be calculated");
  // contributors that do not come from the rig
  MDOF_TRY(std::vector<Contributor> own, removed_drift(rig, run));
  const Model model = model_of(run);
  if (auto left_out = model_contributor(rig, run, model)) own.push_back(std::move(*left_out));
  if (!rig.declares_uncertainty()) return own;
  MDOF_TRY(Solver solver, Solver::create(rig, model));
  auto points = point_sensitivities(solver, run);
  const SharedBasis basis(new Basis{rig, std::move(solver), run, std::move(points)});
  MDOF_CHECK(check_run(*basis));
  MDOF_CHECK(check_angles(basis->rig));
  std::vector<Contributor> list = List(basis).take();
  for (auto&& more : {physics_contributors(rig, basis->solver, run, basis->points),
                      expansion_contributors(rig, basis->solver, basis->points)})
    list.insert(list.end(), more.begin(), more.end());
  name_probe_correlations(rig, list);
  name_common_surfaces(rig, list);
  std::move(own.begin(), own.end(), std::back_inserter(list));
  return list;
}

void shift(std::vector<MeasuredPoint>& points, const PointShifts& shifts) {
  for (std::size_t j = 0; j < shifts.size(); ++j)
    for (std::size_t e = 0; e < kErrorCount; ++e) points[j].errors.local[e] += shifts[j][e];
}

}  // namespace mdof::algo
