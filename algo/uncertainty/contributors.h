// The uncertainties that a rig declares (schema/rig/uncertainty.h) as contributors, and by how much
// each one changes the errors of a run (GUM 5.1.3). The sensitivities are differences of the model
// itself.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "algo/uncertainty/effects/flatness.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/contributor_name.h"

namespace mdof::algo {

// Change of the errors of each point of the run: local frame, stated at the same place as the
// errors of the run; 0 for a point without errors.
using PointShifts = std::vector<Errors5>;

// One line of a budget. Contributors are independent of each other. The effect of a contributor is
// common to all points of the run, so it cancels where a figure takes differences of points.
struct Contributor {
  ContributorName name;
  std::string key;  // key in the rig: "u_sensitivity_ppm"; empty: found in the run itself
  DeclaredUncertainty declared;
  double to_unit = 1;  // from SI to the unit in which it is shown
  std::string unit;    // "ppm"
  // Shifts by one standard uncertainty, as independent parts whose squares add. Most contributors
  // have one part, a direction has two (about two axes across it), the encoder has one for each
  // target. A calibration covariance and the covariance of a flatness (flatness.h) have several.
  std::function<std::vector<PointShifts>()> parts;
  // Identifies a quantity that stays with a probe in each set-up, by its certificate: rigs with the
  // same text here have one quantity. Empty: each set-up has its own quantity.
  std::string common_as = "";
  // Only for a flatness: several runs over the same plane need their parts calculated together.
  std::shared_ptr<const PlaneFootprints> surface = nullptr;
  std::string surface_as = "";  // rigs with the same text here have one surface
};

// Contributors for the uncertainties that `rig` declares, then for a removed drift, and last for
// the terms that the model of a run by `simplified` leaves out. `run` must be of that rig. A shift
// or rotation of a probe counts by its change since the zero at d = 0 without errors (simulation II
// of algo/sensitivity); the zero itself belongs to the calibration. A flatness counts in the same
// way; it is a random surface that is the same for all visits of a target. Error: a run without
// points, a rig that does not determine all five errors, an angle beyond the limit of the models.
Result<std::vector<Contributor>> contributors(const Rig& rig, const Run& run);

// Adds `shifts` to the errors of these points.
void shift(std::vector<MeasuredPoint>& points, const PointShifts& shifts);

}  // namespace mdof::algo
