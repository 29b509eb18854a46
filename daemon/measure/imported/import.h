// Imports the measurement of another instrument as a run. The run contains the name and the hash of
// the file.
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
  int opened = -1;  // descriptor of `file` if the file is open already; otherwise -1
  Axis axis = Axis::x;
  std::string error;   // name of the error, "EXX"; empty: the positioning error of the axis
  std::string format;  // as in read_imported_file(); empty: the format is recognised from the
                       // content of the file
  std::optional<double> u_um, u_urad;  // standard uncertainty of each deviation, from an effect
                                       // that is common to all deviations
  std::string note;
  // For positioning only. `sense`: sense of the deviations. The default is the sense of the
  // command, as in ISO 230-2 and in the file formats. `against_command`: travel of the axis. True
  // (travel "-") means that the body moves towards - when the command increases.
  std::optional<PositioningSense> sense;
  std::optional<bool> against_command;
  algo::TableLimits limits = {};
  bool despite_warnings = false;  // true: also import a doubtful file
};

// Returns a complete run. The run is not stored yet. Errors:
//   - those of imported_error() and read_imported_file();
//   - an uncertainty is negative, not finite, or has the wrong unit;
//   - a deviation, or the slope between the means of two targets, exceeds its limit;
//   - the file is doubtful (gate.h).
Result<Run> imported_run(const ImportRequest& request);

// A notice if the unit of these deviations is probably wrong, because a deviation is as large as
// the smallest interval between two targets, or because all deviations are smaller than 0.1 µm.
Notices deviation_unit_notices(std::vector<double> position_m,
                               const std::vector<double>& deviation_m);

// The document of `mdof import --json` and run.import. The run is stored already.
std::string import_document(const RunHeader& header, std::size_t readings);

}  // namespace mdof::daemon
