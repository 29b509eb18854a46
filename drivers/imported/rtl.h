// Reads Renishaw's text format of a test (.rtl). Its sections are HEADER::, TARGET DATA::,
// USER-TEXT::, RUNS:: and DEVIATIONS::. Targets are in mm, deviations in µm. There is no public
// description; the layout is taken from independent programs that read and write the format. Odd
// runs go from the first target to the last target, even runs go back. The scale of the angles in
// .rta files is not known.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"
#include "schema/imported/series.h"

namespace mdof::drivers {

// Returns the readings in the order of the file, and what the file states about machine, date and
// place. A text in a legacy code page is read as Latin-1. If all runs of one direction contain
// zeros only, these runs are omitted and a notice is made. If the targets decrease, the odd runs
// have the - direction and a notice is made. Errors name file, line and the expected contents:
// - the number of targets, runs or deviations is wrong;
// - the targets neither increase nor decrease;
// - a deviation or a number is given twice or is missing;
// - a run has the wrong direction or contains zeros only;
// - the file contains angles (according to its name, its type or its Owner);
// - `error_is_stated` is false and the type of the file is straightness, flatness or squareness, so
//   that the user must name the error.
Result<ImportedSeries> parse_rtl(std::string_view text, const std::string& source,
                                 bool error_is_stated = false);

}  // namespace mdof::drivers
