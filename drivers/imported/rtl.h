// Renishaw's text form of a test (.rtl): sections HEADER::, TARGET DATA::, USER-TEXT::, RUNS::,
// DEVIATIONS::. Targets are in mm, deviations in µm. There is no public description; the layout is
// that of independent programs which read and write it. Odd runs go forward; even ones backward,
// from the last target to the first.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/imported/series.h"

namespace mdof::drivers {

// Readings in the order of the file, and what it says of machine, date and place (a legacy code
// page is taken as Latin-1). Errors name file, line and what was expected: counts that do not hold,
// targets that do not rise, a deviation or a count that is given twice or missing, a run that does
// not go its way or has only zeros, a file of angles (by its type or its Owner).
Result<ImportedSeries> parse_rtl(std::string_view text, const std::string& source);

}  // namespace mdof::drivers
