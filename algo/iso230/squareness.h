// Squareness of two axes (Fig. 6, algo/README.md).
#pragma once

#include <optional>

#include "schema/base/result.h"
#include "schema/iso230/squareness.h"
#include "schema/rig/reference.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Angle error of the square and its u from the user; they replace the values of the rigs.
struct ArtefactGiven {
  std::optional<double> angle_error_rad, u_rad;
};

// Returns the square that both rigs describe, with the measured corner (SquareArtefact::corner).
// The corner follows from the outward directions of its two faces. For the top plane of a rig, this
// is the direction of its normal; for any other face, the direction from the origin of M to the
// face. Errors:
// - a value from the user is above 10 mrad or not a number
// - the rigs describe different squares
// - an angle error is given, but the direction of a face is unknown: the face is at 0, there are
//   faces on both sides, or the normal of the face contradicts its position
Result<SquareArtefact> combined_artefact(const Rig& rig_a, const Rig& rig_b,
                                         const ArtefactGiven& given);

// Reference points of the straightness of the two axes. At another point, the slope of
// straightness, and therefore the squareness, differs by the lever arm times the slope of an angle.
struct StatedPair {
  StatedAt a = kAtFixture, b = kAtFixture;
  bool operator==(const StatedPair&) const = default;
};

// Returns the axes of the runs. Error: the same axis, or not in the order X, Y, Z.
Result<AxisPair> pair_of(const Run& run_a, const Run& run_b);

// Calculates the squareness from the straightness of each axis in the direction of the other axis:
// EYX and EXY for X and Y, EZX and EXZ for X and Z, EZY and EYZ for Y and Z. Fits a least-squares
// line to the mean of both approaches of each straightness error. Adds square_tilt_rad(). `at`
// gives the reference points of the straightness. With the fixture (not with the carriage) the
// slope is comparable with the face of the square, and the encoder zeros of the two runs may
// differ. u of a slope is the larger of two values: the propagated u of the targets (GUM 5.1.2),
// and s/√n of the slopes of n repeats. Errors: runs of the same axis, or not in the order X, Y, Z;
// fewer than three targets; the errors of check_usable().
Result<Squareness> squareness(const Run& run_a, const Run& run_b, const SquareArtefact& artefact,
                              bool take_partial = false, const StatedPair& at = {});

}  // namespace mdof::algo
