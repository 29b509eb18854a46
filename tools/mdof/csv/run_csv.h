// A run as CSV: for spreadsheets and scripts.
#pragma once

#include <string>

#include "schema/run.h"

namespace mdof::tools {

// A row a point: its place in the sequence, five errors and their standard uncertainties in the
// units of their names, samples, flags, and why it is not solved.
std::string points_csv(const Run& run);
// A row an error and approach; an angle has no straightness and a straightness no range.
std::string figures_csv(const Run& run);

}  // namespace mdof::tools
