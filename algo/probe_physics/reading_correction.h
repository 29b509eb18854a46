// Corrects the readings of the probes at one position of the axis for the tilt of the target and
// for the difference of the air from that of the calibration.
//
// The tilt of the target at each probe is from the solved errors, so it is found by iteration:
// solve, correct, solve again, until no reading changes by more than 1 pm. The zero of a probe is
// at the nominal position of the target with the tilt that the rig states there, so only changes
// from there are corrected. The true angle of a probe in its clamp is unknown (u_direction_mrad is
// its uncertainty).
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
  std::vector<double> readings_m;  // in the order of the rig; NaN: lost, or see why_not
  // Correction added to each reading; 0 for a lost probe.
  std::vector<double> tilt_m, dielectric_m;
  int rounds = 0;
  // Why a reading cannot be corrected; empty: all are corrected. `closed`: probe with a closed gap.
  std::string why_not;
  std::optional<std::size_t> closed;
};

class ReadingCorrection {
 public:
  // `rig.physics` is set and declares what these corrections need. `solver` is made from the rig
  // and must outlive this object.
  ReadingCorrection(const Rig& rig, const Solver& solver, WhichCorrections which);

  // Readings as in Solver::solve(). If probes are lost so that the errors cannot be solved, the
  // tilt is unknown and only the air is corrected. `air`: at the time of the readings; ignored
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
  std::vector<double> zero_shown_m_;  // shown gap at displacement 0
  double permittivity_at_calibration_ = 1;
  WhichCorrections which_;
};

}  // namespace mdof::algo
