// Renishaw's text form of a test (.rtl): sections HEADER::, TARGET DATA::, USER-TEXT::, RUNS::,
// DEVIATIONS::. Targets are in mm, deviations in µm. There is no public description; the layout is
// that of independent programs which read and write it. Odd runs go from the first target to the
// last, even ones back. Of angles (.rta) the scale is not known.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/imported/series.h"

namespace mdof::drivers {

// Readings in the order of the file, and what it says of machine, date and place (a legacy code
// page is taken as Latin-1). Errors name file, line and what was expected: counts that do not hold,
// targets that neither rise nor fall, a deviation or a count that is given twice or missing, a run
// that does not go its way or has only zeros, a file of angles (by its name, its type or its
// Owner), or likewise of straightness, flatness or squareness unless `error_is_stated`: the import
// names the measured error. All runs of one direction with only zeros are left out, with a notice;
// so is said that targets fall, where the odd runs go in the - direction.
Result<ImportedSeries> parse_rtl(std::string_view text, const std::string& source,
                                 bool error_is_stated = false);

}  // namespace mdof::drivers
