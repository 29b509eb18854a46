// Errors stated at another point of the metrology frame (Eq. 1, schema/rig/reference.h).
//
// The target's error at P is e(P) = X_MC (P - d x̂) - P = (R - I)(P - d x̂) + (0, δy, δz), so that
// from P to P' it changes by (R - I)(P' - P); C's origin is at P = d x̂. The angles are the same
// everywhere. R is that of the model: I + [ε]× for the small-angle models, else the true rotation.
#pragma once

#include <Eigen/Core>

#include "schema/rig/reference.h"
#include "schema/run.h"

namespace mdof::algo {

// P in the axis' local frame, m, when the target has travelled d = travel_m.
Eigen::Vector3d reference_point(const StatedAt& at, Axis axis, double travel_m);

// `errors` of the target, stated at `from`, with their covariance (first order: the slope of a
// straightness in an angle is the arm). The component of e(P) along the motion is left out: it is
// positioning, which five probes and an encoder do not see.
AxisErrors restate(const AxisErrors& errors, Model model, Axis axis, double travel_m,
                   const StatedAt& from, const StatedAt& to);

// All points of a run, and its figures made of them anew.
Run restate(Run run, const StatedAt& to);

}  // namespace mdof::algo
