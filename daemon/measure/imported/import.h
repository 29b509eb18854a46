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
  int opened = -1;  // its descriptor where it is open already
  Axis axis = Axis::x;
  std::string error;   // "EXX"; empty: the positioning of the axis
  std::string format;  // as of read_imported_file(); empty: by what the file contains
  std::optional<double> u_um, u_urad;  // standard uncertainty of a deviation, common to all
  std::string note;
  // Of positioning alone: the sense of its deviations (the command's where it is not given, as ISO
  // 230-2 and the formats define them), and the travel of the axis, "-" where its body goes along -
  // as the command grows.
  std::optional<PositioningSense> sense;
  std::optional<bool> against_command;
  algo::TableLimits limits = {};
  bool despite_warnings = false;  // also a doubtful file
};

// Complete, not stored. Errors: those of imported_error() and read_imported_file(); an uncertainty
// that is negative, not finite or in the other unit; deviations beyond the limits, or means of
// targets whose slope is; a doubtful file (gate.h).
Result<Run> imported_run(const ImportRequest& request);

// What `mdof import --json` and run.import say of a run that was imported and stored.
std::string import_document(const RunHeader& header, std::size_t readings);

}  // namespace mdof::daemon
