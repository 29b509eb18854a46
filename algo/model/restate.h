// Converts errors to another point of the metrology frame (Eq. 1, schema/rig/reference.h).
//
// The error of the target at the point P is
//   e(P) = X_MC (P - d x̂) - P = (R - I)(P - d x̂) + (0, δy, δz).
//
// At another point P' the error differs by (R - I)(P' - P). The origin of C is at P = d x̂. The
// angles are the same at all points. R is I + [ε]× for the small-angle models and the true rotation
// for the rigid model. For a moving fixture, see algo/model/moving_body.h.
#pragma once

#include <Eigen/Core>

#include "algo/model/solver.h"
#include "schema/rig/reference.h"
#include "schema/run.h"

namespace mdof::algo {

// Returns the model that calculated the errors of the run; rigid if the run names no model, such as
// an imported run.
Model model_of(const Run& run);

// Returns P in the local frame of the axis, m, after a travel d = travel_m of the target.
Eigen::Vector3d reference_point(const StatedAt& at, Axis axis, double travel_m);

// Converts `errors` of the moving body and their covariance from the point `from` to the point
// `to`. Without sides, the errors are the errors of the target, whichever body moves. The
// covariance is converted to first order: the derivative of a straightness error by an angle is the
// lever arm. The component of e(P) along the motion, which is the positioning error, is left out,
// because five probes and an encoder do not measure it.
AxisErrors restate(const AxisErrors& errors, Model model, const MovingAxis& moving, double travel_m,
                   const StatedAt& from, const StatedAt& to);

// Calculates the errors of a point from its readings, at the point `to`.
AxisErrors solved(const Solver& solver, const Point& point, const MovingAxis& moving,
                  const StatedAt& to);

// Converts all points of a run to the point `to` and calculates the straightness and angle figures
// again.
Run restate(Run run, const StatedAt& to);

}  // namespace mdof::algo
