// The uncertainties that a rig declares (schema/rig/uncertainty.h), as contributors. Each
// contributor contains its effect on the errors of a run (GUM 5.1.3). The effects are calculated as
// differences of the measurement model.
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

// Change of the errors of each point of a run. Local frame, at the reference point of the run. 0
// for a point without valid errors.
using PointShifts = std::vector<Errors5>;

// One line of a budget. Contributors are independent of each other. One contributor acts on all
// points of the run at the same time. Therefore its effect can cancel in a figure that is
// calculated from differences of points.
struct Contributor {
  ContributorName name;
  std::string key;  // key in the rig: "u_sensitivity_ppm"; empty: calculated from the run
  DeclaredUncertainty declared;
  double to_unit = 1;  // factor from SI to `unit`
  std::string unit;    // "ppm"
  // Changes of the errors by one standard uncertainty, as independent parts; the squares of the
  // parts add. Number of parts:
  //   direction: two (rotations about two axes perpendicular to the probe)
  //   encoder: one for each target, at most 256
  //   calibration covariance, flatness (flatness.h), linearity, expansion: one or more
  //   all others: one
  std::function<std::vector<PointShifts>()> parts;
  // Text that identifies a quantity of a probe that does not change with the set-up. If two rigs
  // have the same text here, the quantity is the same. Empty: the quantity is different in each
  // set-up.
  std::string common_as = "";
  // Only for a flatness: data for the calculation of the parts of several runs over the same plane.
  std::shared_ptr<const PlaneFootprints> surface = nullptr;
  std::string surface_as = "";  // if two rigs have the same text here, the surface is the same
};

// Contributors in this order: the uncertainties that `rig` declares, a removed drift, and the terms
// that Model::simplified omits. `run` must be measured with `rig`. The probes were zeroed at the
// travel d = 0 without errors. Therefore a shift or rotation of a probe contributes its effect
// minus its effect at d = 0 (simulation II of algo/sensitivity). The heights of a flatness, a
// random surface that is the same for all visits of a target, contribute in the same way. The
// uncertainty of the zero is a part of the calibration. Errors: a run without points; a rig that
// does not determine all five errors; an angle beyond the limit of the models.
Result<std::vector<Contributor>> contributors(const Rig& rig, const Run& run);

// Adds `shifts` to the errors of these points.
void shift(std::vector<MeasuredPoint>& points, const PointShifts& shifts);

}  // namespace mdof::algo
