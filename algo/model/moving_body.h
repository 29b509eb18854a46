// Converts the errors of the target in M to the errors of the body that moves, and back.
//
// If the fixture moves, its pose relative to the target is the inverse of the pose (R, d x̂ + δ) of
// the target in M. Its rotation is Rᵀ, and its error at the origin of the carriage is -Rᵀ δ.
//
// The errors of a run have the sign of the target (schema/axis.h). For a moving fixture they are
// the negative errors of the fixture. To first order, these are the errors of the target; the terms
// of second order are 100 nm at 1 mrad and 100 µm.
#pragma once

#include "schema/axis.h"
#include "schema/point.h"

namespace mdof::algo {

// Both functions convert errors at the origin of the carriage. Nothing changes if the target moves,
// or if the model is `simplified`, which is of first order. The model `exact` does not distinguish
// the order of the rotations, so that its angles do not change.
AxisErrors errors_of_moving_body(AxisErrors of_target, Model model, const MovingAxis& moving);
AxisErrors errors_of_target(AxisErrors of_moving_body, Model model, const MovingAxis& moving);

}  // namespace mdof::algo
