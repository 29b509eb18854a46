// Squareness of two axes (Fig. 6, algo/README.md).
#pragma once

#include <optional>

#include "schema/base/result.h"
#include "schema/iso230/squareness.h"
#include "schema/rig/reference.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Values of the square that the user gives; they replace those of the rigs.
struct ArtefactGiven {
  std::optional<double> angle_error_rad, u_rad;
};

// The square that both rigs describe, with the corner that their planes show. A face that is the
// top plane of a motion faces along the normal of this plane; any other face is on the side of M's
// origin where its position is. Errors: a given value is above 10 mrad or not a number; the rigs
// differ; an angle error is given and the side of a face is unknown (it is at 0, on both sides, or
// its normal contradicts).
Result<SquareArtefact> combined_artefact(const Rig& rig_a, const Rig& rig_b,
                                         const ArtefactGiven& given);

// Points where the straightness of the two axes is stated. From one point to another the slope
// changes by the lever arm times the slope of an angle, and so does the squareness.
struct StatedPair {
  StatedAt a = kAtFixture, b = kAtFixture;
  bool operator==(const StatedPair&) const = default;
};

// Fits least-squares lines to the mean of both approaches of the straightness of each axis in the
// direction of the other (EYX over x and EXY over y; with Z EZX and EXZ, EZY and EYZ). They are at
// the fixture unless `at` states another point, not at the carriage: slope and face are then
// comparable, and neither run needs to be zeroed against the other. u of a slope is the larger of
// the propagated u of the targets (GUM 5.1.2) and the scatter of the slopes of the repeats, s/√n.
// Errors: runs of one axis, or not in the order X, Y, Z; series of fewer than three targets; those
// of check_usable().
Result<Squareness> squareness(const Run& run_a, const Run& run_b, const SquareArtefact& artefact,
                              bool take_partial = false, const StatedPair& at = {});

}  // namespace mdof::algo
