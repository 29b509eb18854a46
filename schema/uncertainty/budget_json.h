// JSON of uncertainty budgets. The command line and the RPC use the same JSON.
#pragma once

#include <optional>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof {

// Writes {"EYX_straightness_um": {"value", "u", "u_random", "nu_eff", "k", "U", "U_by",
// "noise_only", "u_covers", "not_declared", "contributors": [{"contributor", "key", "value",
// "unit", "distribution", "sensitivity", "contribution", "share", "dof"}]}}. Values are in the unit
// at the end of the figure's name. Infinite degrees of freedom are null. The sensitivity of a
// contributor that is estimated from the run is null. If there are Monte Carlo trials, the object
// also has "trials": {"trials", "seed", "u", "low", "high"}. If there is a decision, each figure
// also has the members of write_decision().
void write_budgets(JsonWriter& json, const std::vector<Budget>& budgets,
                   const std::optional<Decision>& decision = std::nullopt);

// Writes "value", "u", "u_random", "nu_eff", "k", "U", "U_by" into an open object.
void write_stated_members(JsonWriter& json, const Budget& budget);

// Writes "uncertainty": {"EYX_straightness_um": {"value", "u", "u_random", "nu_eff", "k", "U",
// "U_by"}} into an open object: the results of the budgets, without their contributors. If there
// are no budgets, "uncertainty_reason" states the reason.
void write_stated(JsonWriter& json, const StatedFigures& figures);

// As write_covers() for a run (run_uncertainty.h), for these figures.
void write_covers(JsonWriter& json, const std::vector<Budget>& budgets);

}  // namespace mdof
