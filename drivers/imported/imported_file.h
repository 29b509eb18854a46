// A series of deviations that another instrument measured, from a file.
#pragma once

#include <string>

#include "schema/base/result.h"
#include "schema/imported/series.h"

namespace mdof::drivers {

struct AskedError {
  bool angle = false;
  bool is_stated = false;  // by its name; else it is positioning by default
};

// `format`: "csv" (position_mm, deviation_um or _urad, and direction, run where there are such),
// "iso230-2" (target_mm, direction, run, deviation_um), "rtl" (rtl.h); empty: by what the file
// contains. An angle is read from CSV alone. What a file says of its kind counts unless the error
// is stated (rtl.h). `descriptor`: of the file where it is open already, -1: not. Errors name
// file, line, column and remedy.
Result<ImportedSeries> read_imported_file(const std::string& path, const std::string& format,
                                          const AskedError& error, int descriptor = -1);

}  // namespace mdof::drivers
