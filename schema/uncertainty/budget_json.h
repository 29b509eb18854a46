// JSON of uncertainty budgets: the same for the command line and the RPC.
#pragma once

#include <optional>
#include <vector>

#include "schema/base/json_writer.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/conformity.h"

namespace mdof {

// {"EYX_straightness_um": {"value", "u", "u_random", "nu_eff", "k", "U", "U_by", "noise_only",
// "u_covers", "not_declared", "contributors": [{"contributor", "key", "value", "unit",
// "distribution", "sensitivity", "contribution", "share", "dof"}]}}, values in the unit of the
// figure's name. Infinite degrees of freedom are null. The sensitivity of a contributor that is
// estimated from the run itself is null. With trials: "trials": {"trials", "seed", "u", "low",
// "high"}. With a decision each figure has the members of write_decision().
void write_budgets(JsonWriter& json, const std::vector<Budget>& budgets,
                   const std::optional<Decision>& decision = std::nullopt);

// Writes "value", "u", "u_random", "nu_eff", "k", "U", "U_by" into an open object.
void write_stated_members(JsonWriter& json, const Budget& budget);

// Writes "uncertainty": {"EYX_straightness_um": {"value", "u", "u_random", "nu_eff", "k", "U",
// "U_by"}} into an open object: the results of budgets, without their contributors. If budgets are
// omitted, "uncertainty_reason" follows.
void write_stated(JsonWriter& json, const StatedFigures& figures);

// As write_covers() of runs, for these figures.
void write_covers(JsonWriter& json, const std::vector<Budget>& budgets);

}  // namespace mdof
