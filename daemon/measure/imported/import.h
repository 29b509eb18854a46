// Imports the measurement of another instrument as a run. The file is read once; its name and hash
// are kept.
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
  int opened = -1;  // descriptor if the file is open already
  Axis axis = Axis::x;
  std::string error;   // "EXX"; empty: the positioning of the axis
  std::string format;  // as in read_imported_file(); empty: by the content of the file
  std::optional<double> u_um, u_urad;  // standard uncertainty of a deviation, common to all
                                       // deviations
  std::string note;
  // For positioning only: the sense of the deviations (default: the sense of the command, as in ISO
  // 230-2 and the file formats), and the travel of the axis: "-" (true) if the body moves towards -
  // while the command increases.
  std::optional<PositioningSense> sense;
  std::optional<bool> against_command;
  algo::TableLimits limits = {};
  bool despite_warnings = false;  // also import a doubtful file
};

// The result is a complete run, not yet stored. Errors: those of imported_error() and
// read_imported_file(); an uncertainty that is negative, not finite or of the wrong unit;
// deviations, or slopes between target means, beyond the limits; a doubtful file (gate.h).
Result<Run> imported_run(const ImportRequest& request);

// The document of `mdof import --json` and run.import for an imported, stored run.
std::string import_document(const RunHeader& header, std::size_t readings);

}  // namespace mdof::daemon
