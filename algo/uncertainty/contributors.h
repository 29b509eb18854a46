// What a rig declares not to know (schema/rig/uncertainty.h), and by how much each of it changes
// the errors of a run: GUM 5.1.3, the sensitivities by differences of the model itself.
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

// Change of the errors of each point of the run: local frame, stated where the run is; 0 for a
// point without errors.
using PointShifts = std::vector<Errors5>;

// One line of a budget. Contributors are independent of each other. What one does is common to all
// points of the run, and so cancels where a figure takes differences of points.
struct Contributor {
  ContributorName name;
  std::string key;  // as the rig declares it: "u_sensitivity_ppm"; empty: seen in the run itself
  DeclaredUncertainty declared;
  double to_unit = 1;  // from SI to the unit in which it is shown
  std::string unit;    // "ppm"
  // The shifts by one standard uncertainty of it, as independent parts whose squares add: one part,
  // but two for a direction (two axes across it), one a target for the encoder, and those of the
  // covariances of a calibration or of the covariance of a flatness (flatness.h).
  std::function<std::vector<PointShifts>()> parts;
  // Of what goes with a probe from set-up to set-up, as its certificate does: two rigs that have
  // the same here have one quantity. Empty: each set-up has its own.
  std::string common_as = "";
  // Of a flatness: several runs over the same plane need their parts made together.
  std::shared_ptr<const PlaneFootprints> surface = nullptr;
  std::string surface_as = "";  // of rigs that have the same here it is one surface
};

// Of what `rig` declares, in its order, and of a removed drift; the run is of that rig. What moves
// or turns a probe counts by what it changes after the zero at d = 0 without errors (simulation II
// of algo/sensitivity): the zero itself is calibration's. So does a flatness, a random surface that
// is the same for all visits of a place. Of a run by `simplified` what that model leaves out, last.
// Error: a rig that cannot see all five errors, an angle beyond what the models take.
Result<std::vector<Contributor>> contributors(const Rig& rig, const Run& run);

// Adds them to the errors of these points.
void shift(std::vector<MeasuredPoint>& points, const PointShifts& shifts);

}  // namespace mdof::algo
