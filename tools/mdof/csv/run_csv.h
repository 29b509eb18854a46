// A run as CSV, for spreadsheets and scripts.
#pragma once

#include <string>

#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::tools {

// One row for each point, with these columns:
// - target, position and place in the sequence
// - the five errors, in the units of their keys
// - combined standard uncertainty of each error, and its part from noise
// - expanded uncertainty of each error (95 %)
// - number of samples, flags, and the reason if the point is not solved
// - the sources that the uncertainties include
std::string points_csv(const Run& run, const RunUncertainty& uncertainty);
// One row for each error and approach, and for the mean of both approaches. The columns of
// straightness are empty for angles, and the column of the range is empty for straightness errors.
// Only the mean of both approaches has uncertainties, from `figures`.
std::string figures_csv(const Run& run, const StatedFigures& figures);

}  // namespace mdof::tools
