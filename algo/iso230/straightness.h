// Straightness with the reference lines of ISO 230-1, and angles relative to the first target.
#pragma once

#include <vector>

#include "schema/iso230/reference_lines.h"
#include "schema/run.h"

namespace mdof::algo {

// Returns figures for the two straightness errors and for each approach with at least three
// targets. Their reference point is the reference point of `points`.
std::vector<StraightnessFigure> straightness(const MovingAxis& moving,
                                             const std::vector<MeasuredPoint>& points);

// Returns the straightness of each series with at least three targets for each of the three
// reference lines.
std::vector<StraightnessLines> straightness_lines(const MovingAxis& moving,
                                                  const std::vector<MeasuredPoint>& points);

// Returns figures for the three angles and for each approach with at least two targets.
std::vector<AngleFigure> angles(const MovingAxis& moving, const std::vector<MeasuredPoint>& points);

}  // namespace mdof::algo
