// Corrects the readings of the probes at one position of the axis for the tilt of the target, and
// for the permittivity of the air if it differs from the permittivity during the calibration.
//
// The tilt of the target follows from the solved errors, so it is found by iteration: solve,
// correct, solve again, until no reading changes by more than 1 pm. A probe reads zero at the
// nominal position of the target with the tilt that the rig states for this position. Only the
// differences from this state are corrected. The true angle of a probe in its clamp is unknown;
// u_direction_mrad is the uncertainty of this angle.
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
  // Corrected readings in the order of the rig; NaN: lost, or see why_not.
  std::vector<double> readings_m;
  // Correction added to each reading; 0 for a lost probe.
  std::vector<double> tilt_m, dielectric_m;
  int rounds = 0;
  // why_not: reason why a reading cannot be corrected; empty: all readings are corrected. closed:
  // index of a probe with a closed gap.
  std::string why_not;
  std::optional<std::size_t> closed;
};

class ReadingCorrection {
 public:
  // `rig.physics` must be set and must contain the values that are necessary for these corrections.
  // `solver` must be created from the rig and must exist longer than this object.
  ReadingCorrection(const Rig& rig, const Solver& solver, WhichCorrections which);

  // The readings are as in Solver::solve(). If so many probes are lost that the errors cannot be
  // solved, the tilt is unknown, and only the effect of the air is corrected. `air`: ambient
  // conditions at the time of the readings; ignored without the dielectric correction.
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
  std::vector<double> zero_shown_m_;  // shown gap at displacement 0
  double permittivity_at_calibration_ = 1;
  WhichCorrections which_;
};

}  // namespace mdof::algo
