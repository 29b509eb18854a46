// Straightness with the reference lines of ISO 230-1, and angles relative to the start.
#pragma once

#include <vector>

#include "schema/iso230/reference_lines.h"
#include "schema/run.h"

namespace mdof::algo {

// For the two straightness errors and each approach with at least three targets, at the point where
// `points` are stated.
std::vector<StraightnessFigure> straightness(const MovingAxis& moving,
                                             const std::vector<MeasuredPoint>& points);

// The same series about each of the three reference lines, if they have at least three targets.
std::vector<StraightnessLines> straightness_lines(const MovingAxis& moving,
                                                  const std::vector<MeasuredPoint>& points);

// For the three angles and each approach with at least two targets.
std::vector<AngleFigure> angles(const MovingAxis& moving, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
