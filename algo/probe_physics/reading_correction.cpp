#include "algo/probe_physics/reading_correction.h"

#include <algorithm>
#include <cmath>

#include "algo/model/small_rotation.h"
#include "algo/probe_physics/air.h"
#include "algo/probe_physics/gap.h"
#include "schema/base/number/number_text.h"
#include "schema/sample.h"
#include "schema/units.h"

namespace mdof::algo {
namespace {

constexpr int kMostRounds = 50;  // a large tilt with a small gap requires 10 rounds
constexpr double kDone_m = 1e-12;

std::string closed_text(const std::string& probe, const ProbePhysics& physics, double gap_m,
                        double tilt_square) {
  const std::string what =
      gap_m > 0
          ? "the target is tilted by " + plain_number(1e3 * std::sqrt(tilt_square)) +
                " mrad, so that an electrode of " + plain_number(to_mm(physics.sensing_radius_m)) +
                " mm radius would touch the target at a gap of " + plain_number(to_um(gap_m)) +
                " um"
          : "the gap would be " + plain_number(to_um(gap_m)) + " um";
  return "the reading of probe " + probe + " cannot be corrected: " + what +
         "; correct standoff_um or sensing_radius_mm in the rig";
}

}  // namespace

ReadingCorrection::ReadingCorrection(const Rig& rig, const Solver& solver, WhichCorrections which)
    : solver_(&solver), physics_(rig.physics->probes), which_(which) {
  for (const Probe& probe : rig.probes) ids_.push_back(probe.id);
  if (which.dielectric)
    permittivity_at_calibration_ = air_permittivity(rig.physics->air->calibration);
  for (std::size_t k = 0; k < physics_.size(); ++k) {
    ProbePhysics& of = physics_[k];
    if (!which.tilt) of.sensing_radius_m = 0;
    const double nominal =
        tilt_of(solver.fixture().probes[k], Eigen::Matrix3d::Identity()).squaredNorm();
    zero_shown_m_.push_back(of.standoff_m - gap_decrease_by_tilt_m(of, nominal, of.standoff_m));
  }
}

bool ReadingCorrection::correct_probe(std::size_t k, double shown_m, double tilt_square,
                                      double ratio, CorrectedReadings& out) const {
  const double shown_gap_m = zero_shown_m_[k] - shown_m;
  const double gap_m = true_gap_m(physics_[k], shown_gap_m, tilt_square, ratio);
  // The check uses the shown gap, because the gap of the formula increases with the tilt and is
  // never small enough to touch.
  if (touches(physics_[k], tilt_square, shown_gap_m)) {
    out.closed = k;
    out.why_not = closed_text(ids_[k], physics_[k], shown_gap_m, tilt_square);
    out.readings_m[k] = kNaN;
    return false;
  }
  out.readings_m[k] = physics_[k].standoff_m - gap_m;
  out.dielectric_m[k] = -shown_gap_m * (ratio - 1);
  out.tilt_m[k] = out.readings_m[k] - shown_m - out.dielectric_m[k];
  return true;
}

// Returns false if a gap is closed.
bool ReadingCorrection::round(const std::vector<double>& shown_m, const Eigen::Matrix3d& R_MC,
                              double ratio, CorrectedReadings& out) const {
  for (std::size_t k = 0; k < shown_m.size(); ++k) {
    if (!std::isfinite(shown_m[k])) continue;
    const double tilt_square = tilt_of(solver_->fixture().probes[k], R_MC).squaredNorm();
    if (!correct_probe(k, shown_m[k], tilt_square, ratio, out)) return false;
  }
  return true;
}

CorrectedReadings ReadingCorrection::correct(double travel_m, const std::vector<double>& readings_m,
                                             const std::vector<double>& u_m, const Air& air) const {
  CorrectedReadings out;
  out.readings_m = readings_m;
  out.tilt_m.assign(readings_m.size(), 0.0);
  out.dielectric_m = out.tilt_m;
  const double ratio =
      which_.dielectric ? air_permittivity(air) / permittivity_at_calibration_ : 1.0;
  if (!round(readings_m, Eigen::Matrix3d::Identity(), ratio, out)) return out;
  if (!which_.tilt) return out;
  for (double change_m = 1; change_m > kDone_m; ++out.rounds) {
    if (out.rounds == kMostRounds) {
      out.why_not =
          "the tilt correction does not converge, because the angles are too large for the gaps; "
          "correct sensing_radius_mm, tilt_factor or standoff_um in the rig";
      out.readings_m.assign(readings_m.size(), kNaN);
      return out;
    }
    const AxisErrors errors = solver_->solve(travel_m, out.readings_m, u_m);
    if (!errors.valid) return out;
    const std::vector<double> before = out.readings_m;
    const auto R_MC = local_rotation(solver_->fixture().axis, errors.local).R_MC;
    if (!round(readings_m, R_MC, ratio, out)) return out;
    change_m = 0;
    for (std::size_t k = 0; k < before.size(); ++k)
      if (std::isfinite(before[k]))
        change_m = std::max(change_m, std::abs(out.readings_m[k] - before[k]));
  }
  return out;
}

}  // namespace mdof::algo
