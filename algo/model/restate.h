// Converts errors to another point of the metrology frame (Eq. 1, schema/rig/reference.h).
//
// The target's error at P is e(P) = X_MC (P - d x̂) - P = (R - I)(P - d x̂) + (0, δy, δz). From P
// to P' it changes by (R - I)(P' - P); C's origin is at P = d x̂. The angles are the same
// everywhere. R is I + [ε]× for the small-angle models, otherwise the true rotation.
#pragma once

#include <Eigen/Core>

#include "schema/rig/reference.h"
#include "schema/run.h"

namespace mdof::algo {

// P in the local frame of the axis, m, after a travel d = travel_m of the target.
Eigen::Vector3d reference_point(const StatedAt& at, Axis axis, double travel_m);

// Converts `errors` of the target from `from` to `to`, with their covariance (first order: the
// derivative of a straightness by an angle is the lever arm). The component of e(P) along the
// motion is left out: it is positioning, which five probes and an encoder do not measure.
AxisErrors restate(const AxisErrors& errors, Model model, Axis axis, double travel_m,
                   const StatedAt& from, const StatedAt& to);

// Converts all points of a run and calculates its figures again.
Run restate(Run run, const StatedAt& to);

}  // namespace mdof::algo
