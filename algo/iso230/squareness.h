// Squareness of two axes (Fig. 6, algo/README.md).
#pragma once

#include <optional>

#include "schema/base/result.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/squareness.h"

namespace mdof::algo {

// What a user says of the square beside the rigs; it takes the place of what they say.
struct ArtefactGiven {
  std::optional<double> angle_error_rad, u_rad;
};

// The square as both rigs know it, with the corner that their planes give. Errors: a given value is
// beyond 10 mrad, or none; the rigs differ;
// an angle error is given and a face lies at 0, or on both sides of it, so that the corner is not
// known.
Result<SquareArtefact> artefact_of(const Rig& rig_x, const Rig& rig_y, const ArtefactGiven& given);

// Least-squares lines through the mean of both approaches of EYX over x and of EXY over y, at the
// fixture: slope and face are then compared, and neither run needs to be zeroed against the other.
// u of a slope: the larger of what follows from the targets' u (GUM 5.1.2) and of the scatter of
// the repeats' slopes, s/√n. Refuses runs of the wrong axes, series of fewer than three targets,
// and as check_usable().
Result<Squareness> squareness(const Run& run_x, const Run& run_y, const SquareArtefact& artefact,
                              bool take_partial = false);

}  // namespace mdof::algo
