// Straightness by ISO 230-1 reference lines, angles referred to the start, squareness of two axes.
#pragma once

#include <vector>

#include "schema/result.h"
#include "schema/run.h"
#include "schema/squareness.h"

namespace mdof::algo {

// For the two straightness errors and each approach that has at least three targets.
std::vector<StraightnessFigure> straightness(Axis axis, const std::vector<MeasuredPoint>& points);

// For the three angles and each approach that has at least two targets.
std::vector<AngleFigure> angles(Axis axis, const std::vector<MeasuredPoint>& points);

// DESIGN §3, seed Fig. 6: least-squares lines through the mean of both approaches of EYX over x and
// of EXY over y. u: residuals of both lines (n - 2) and `u_artefact_rad`, GUM 5.1.2. Refuses runs
// of the wrong axes, series of fewer than three targets, and as check_usable().
Result<Squareness> squareness(const Run& run_x, const Run& run_y, double artefact_angle_error_rad,
                              double u_artefact_rad, bool take_partial = false);

}  // namespace mdof::algo
