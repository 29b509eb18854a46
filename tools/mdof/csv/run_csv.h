// A run as CSV, for spreadsheets and scripts.
#pragma once

#include <string>

#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::tools {

// One row for each point: its place in the sequence, the five errors in the units of their keys,
// their combined standard uncertainties, the noise part of these, the expanded uncertainties (95
// %), samples, flags, the reason why the point is not solved, and what the uncertainties cover.
std::string points_csv(const Run& run, const RunUncertainty& uncertainty);
// One row for each error and approach. Angles have no straightness, and straightness errors have no
// range. The mean of both approaches has the uncertainties in `figures`.
std::string figures_csv(const Run& run, const StatedFigures& figures);

}  // namespace mdof::tools
