// A file with a series of deviations that another instrument measured.
#pragma once

#include <string>

#include "schema/base/result.h"
#include "schema/imported/series.h"

namespace mdof::drivers {

struct ExpectedError {
  bool angle = false;
  bool is_stated = false;  // the user named the error; false: positioning by default
};

// `format`: "csv" (position_mm, deviation_um or _urad, optionally direction and run), "iso230-2"
// (target_mm, direction, run, deviation_um), "rtl" (rtl.h); empty: detected from the contents.
// Angles can be read from CSV only. If the error is not stated, the type that the file states is
// checked (rtl.h). `descriptor`: of the open file, or -1. Errors name file, line, column and
// remedy.
Result<ImportedSeries> read_imported_file(const std::string& path, const std::string& format,
                                          const ExpectedError& error, int descriptor = -1);

}  // namespace mdof::drivers
