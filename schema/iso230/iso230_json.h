// Writes reference lines, squareness, parallelism and the parameters of ISO 230-2 as JSON.
#pragma once

#include <vector>

#include "schema/base/json_writer.h"
#include "schema/iso230/parallelism.h"
#include "schema/iso230/positioning.h"
#include "schema/iso230/reference_lines.h"
#include "schema/iso230/squareness.h"

namespace mdof {

// Writes into an open object the members "end_point", "least_squares" and "minimum_zone". Each is
// {"slope_um_per_m", "intercept_um", "zone_um", "residual_um"}.
void write_reference_lines(JsonWriter& json, const ReferenceLines& lines);

// Writes {"EYX_um": {"forward": {"end_point": {...}, ...}, "reverse": {...}, "mean": {...}}, ...}.
void write_straightness_lines(JsonWriter& json, const std::vector<StraightnessLines>& lines);

// Writes {"end_point": {"EC0Y_urad", "slope_EYX_urad", "slope_EXY_urad"}, "least_squares",
// "minimum_zone"}. The names depend on the two axes.
void write_squareness_lines(JsonWriter& json, const Squareness& of, const SquarenessByLine& lines);

// Writes into an open object the member "parallelism": {"EYX": {"end_point": {"angle_urad",
// "slope_a_urad", "slope_b_urad"}, "least_squares", "minimum_zone"}, ...}
void write_parallelism(JsonWriter& json, const Parallelism& parallelism);

// Writes into an open object the members "B_um", "B_mean_um" ... "A_um", and then "targets" with
// the values of each target; unknown values are null. `angle`: the deviations are in rad, and the
// keys end in _urad.
void write_positioning(JsonWriter& json, const Positioning& positioning, bool angle);

// Writes {"coverage", "U_B_um", "U_B_mean_um", "U_R_forward_um" ... "U_M_um", "U_A_reason",
// "u_covers", "not_declared", "R_is_of"}.
void write_run_positioning_uncertainty(JsonWriter& json, const RunPositioningUncertainty& U,
                                       bool angle);

// Writes {"k", "U_device_um", "U_drift_um", "U_E_M_A_um", "U_B_um", "not_covered"}
void write_positioning_uncertainty(JsonWriter& json, const PositioningUncertainty& U);

}  // namespace mdof
