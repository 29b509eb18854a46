// A run as CSV: for spreadsheets and scripts.
#pragma once

#include <string>

#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::tools {

// A row a point: its place in the sequence, five errors in the units of their names, their combined
// standard uncertainties, of these the noise, the expanded uncertainties (95 %), samples, flags,
// why it is not solved, and what the uncertainties cover.
std::string points_csv(const Run& run, const RunUncertainty& uncertainty);
// A row an error and approach; an angle has no straightness and a straightness no range. The mean
// of both approaches has the uncertainties of `figures`.
std::string figures_csv(const Run& run, const StatedFigures& figures);

}  // namespace mdof::tools
