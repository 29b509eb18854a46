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

// Returns the readings in the order of the file, and the file's statements on machine, date and
// place (a legacy code page is read as Latin-1). Errors name file, line and the expected contents:
// wrong counts; targets that neither increase nor decrease; a deviation or a count that is given
// twice or missing; a run in the wrong direction or with zeros only; a file of angles (by its name,
// its type or its Owner); unless `error_is_stated`, also a file of straightness, flatness or
// squareness, because the import names the measured error. If all runs of one direction contain
// zeros only, they are left out, with a notice. Decreasing targets also give a notice: odd runs
// then go in the - direction.
Result<ImportedSeries> parse_rtl(std::string_view text, const std::string& source,
                                 bool error_is_stated = false);

}  // namespace mdof::drivers
