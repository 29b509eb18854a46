// The JSON of uncertainty budgets: one form for the command line and the RPC.
#pragma once

#include <optional>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/uncertainty/budget.h"

namespace mdof {

// {"EYX_straightness_um": {"value", "u", "u_random", "nu_eff", "k", "U", "U_by", "noise_only",
// "not_declared", "contributors": [{"contributor", "key", "value", "unit", "distribution",
// "sensitivity", "contribution", "share", "dof"}]}}, values in the unit of the figure's name.
// Infinite degrees of freedom are null, and so is the sensitivity to what is seen in the run
// itself. With trials: "trials": {"trials", "seed", "u", "low", "high"}. With a tolerance:
// "tolerance" and "conformity", by ISO 14253-1.
void write_budgets(JsonWriter& json, const std::vector<Budget>& budgets,
                   const std::optional<double>& tolerance = std::nullopt);

// "uncertainty": {"EYX_straightness_um": {"value", "u", "u_random", "nu_eff", "k", "U", "U_by"}} of
// an open object: what budgets come to, without their contributors. Where they are left out:
// "uncertainty_reason" behind it.
void write_stated(JsonWriter& json, const StatedFigures& figures);

}  // namespace mdof
