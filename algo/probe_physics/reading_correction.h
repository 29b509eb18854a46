// Readings of the probes at one place of the axis -> what they would be without the tilt of the
// target and without what the air differs from that of the calibration.
//
// The tilt of the target against each probe is that of the solved errors, so that it is found in
// rounds: solve, correct, solve again, until no reading changes by more than 1 pm. A probe's zero
// is taken at the nominal place of the target, with whatever tilt the rig gives it there: only
// what changes from there is corrected. How a probe really stands in its clamp is not known
// (u_direction_mrad says how well).
#pragma once

#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "schema/rig/effects/physics.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

struct WhichCorrections {
  bool tilt = false, dielectric = false;
  bool any() const { return tilt || dielectric; }
};

struct CorrectedReadings {
  std::vector<double> readings_m;  // in the order of the rig; NaN: lost, or why_not says so
  // What was added to each; 0 for a lost probe.
  std::vector<double> tilt_m, dielectric_m;
  int rounds = 0;
  // Why a reading cannot be corrected; empty: all are. `closed`: the probe whose gap is.
  std::string why_not;
  std::optional<std::size_t> closed;
};

class ReadingCorrection {
 public:
  // `rig.physics` is there and declares what these corrections need. `solver` is of the rig, and
  // lives as long.
  ReadingCorrection(const Rig& rig, const Solver& solver, WhichCorrections which);

  // Readings as Solver::solve() takes them. Of readings that see no errors (probes are lost) the
  // tilt is not known: they are corrected for the air alone. `air`: of that time; not looked at
  // without the dielectric correction.
  CorrectedReadings correct(double travel_m, const std::vector<double>& readings_m,
                            const std::vector<double>& u_m, const Air& air) const;

 private:
  bool correct_probe(std::size_t k, double shown_m, double tilt_square, double ratio,
                     CorrectedReadings& out) const;
  bool round(const std::vector<double>& shown_m, const Eigen::Matrix3d& R_MC, double ratio,
             CorrectedReadings& out) const;

  const Solver* solver_;
  std::vector<ProbePhysics> physics_;
  std::vector<std::string> ids_;
  std::vector<double> zero_shown_m_;  // the gap that is shown at displacement 0
  double permittivity_at_calibration_ = 1;
  WhichCorrections which_;
};

}  // namespace mdof::algo
