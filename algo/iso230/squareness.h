// Squareness of two axes (Fig. 6, algo/README.md).
#pragma once

#include <optional>

#include "schema/base/result.h"
#include "schema/iso230/squareness.h"
#include "schema/rig/reference.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// What a user says of the square beside the rigs; it takes the place of what they say.
struct ArtefactGiven {
  std::optional<double> angle_error_rad, u_rad;
};

// The square as both rigs know it, with the corner that their planes show. A face along the
// motion's top plane faces along its normal; any other face lies on the side of M's origin that its
// place gives. Errors: a given value is beyond 10 mrad, or none; the rigs differ; an angle error is
// given and the side of a face is not known (it lies at 0, on both sides, or its normal says
// otherwise).
Result<SquareArtefact> artefact_of(const Rig& rig_a, const Rig& rig_b, const ArtefactGiven& given);

// Where the straightness of each of the two axes is stated. From one point to another a slope
// changes by the arm times the slope of an angle, and the squareness with it.
struct StatedPair {
  StatedAt a = kAtFixture, b = kAtFixture;
  bool operator==(const StatedPair&) const = default;
};

// Least-squares lines through the mean of both approaches of the straightness of each axis along
// the other (EYX over x and EXY over y; with Z EZX and EXZ, EZY and EYZ), at the fixture unless
// `at` says otherwise, not at the carriage: slope and face are then compared, and neither run needs
// to be zeroed against the other. u of a slope: the larger of what follows from the targets' u
// (GUM 5.1.2) and of the scatter of the repeats' slopes, s/√n. Refuses runs of one axis or not in
// the order X, Y, Z, series of fewer than three targets, and as check_usable().
Result<Squareness> squareness(const Run& run_a, const Run& run_b, const SquareArtefact& artefact,
                              bool take_partial = false, const StatedPair& at = {});

}  // namespace mdof::algo
