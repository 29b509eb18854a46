// Reads a file with a series of deviations that another instrument has measured.
#pragma once

#include <string>

#include "schema/base/result.h"
#include "schema/imported/series.h"

namespace mdof::drivers {

struct ExpectedError {
  bool angle = false;
  bool is_stated = false;  // true: the user named the error; false: the default, positioning
};

// Reads the file in the given `format`:
// "csv": columns position_mm, deviation_um or deviation_urad, optionally direction and run;
// "iso230-2": columns target_mm, direction, run, deviation_um;
// "rtl": see rtl.h;
// empty: the format is detected from the contents.
// Angles can be read only from "csv". If the user has not named the error, the type of error that
// an rtl file states is checked (rtl.h). `descriptor`: open file, or -1. Errors name file, line,
// column and remedy.
Result<ImportedSeries> read_imported_file(const std::string& path, const std::string& format,
                                          const ExpectedError& error, int descriptor = -1);

}  // namespace mdof::drivers
