// What another instrument measured, as a run: a file that is read once and kept by name and hash.
#pragma once

#include <optional>
#include <string>

#include "algo/compensation/table_limits.h"
#include "schema/base/result.h"
#include "schema/imported/series.h"
#include "schema/run.h"

namespace mdof::daemon {

struct ImportRequest {
  std::string file;
  Axis axis = Axis::x;
  std::string error;           // "EXX"; empty: the positioning of the axis
  std::string format;          // as of read_imported_file(); empty: by what the file contains
  std::optional<double> u_si;  // standard uncertainty of a deviation, common to all; m or rad
  std::string note;
  algo::TableLimits limits = {};
};

// Complete, not stored. Errors: those of imported_error() and read_imported_file(); an uncertainty
// that is none; deviations beyond the limits, or means of targets whose slope is.
Result<Run> imported_run(const ImportRequest& request);

}  // namespace mdof::daemon
