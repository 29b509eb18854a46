// A run as CSV: for spreadsheets and scripts.
#pragma once

#include <string>

#include "schema/run.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::tools {

// A row a point: its place in the sequence, five errors in the units of their names, their combined
// standard uncertainties, of these the noise, the expanded uncertainties (95 %), samples, flags,
// and why it is not solved.
std::string points_csv(const Run& run, const RunUncertainty& uncertainty);
// A row an error and approach; an angle has no straightness and a straightness no range.
std::string figures_csv(const Run& run);

}  // namespace mdof::tools
