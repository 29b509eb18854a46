// Errors of an axis that another instrument measured: the series that was read from a file, and the
// run that is stored from it.
//
// An imported run has the axis, the file with its hash, and a point for each reading. It has no rig
// and no solved errors: `probe_m` of a point is the deviation (actual - nominal, m or rad), and
// `probe_u_m` its declared standard uncertainty (empty: none declared). Its `model` is the name of
// the error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/axis.h"
#include "schema/base/result.h"
#include "schema/run.h"

namespace mdof {

// 'E', direction and axis: "EXX" for X.
std::string positioning_name(Axis axis);

// One of the six errors of an axis.
struct ImportedError {
  std::string name;                  // "EXX"
  std::optional<std::size_t> named;  // index in error_names(); empty: positioning
  bool angle = false;
  std::string key() const { return name + (angle ? "_urad" : "_um"); }
};
// Error (usage): the axis has no such error; the error names those that it has.
Result<ImportedError> imported_error(Axis axis, const std::string& name);

// A reading, in the order of the file.
struct ImportedReading {
  double position_m = 0;
  int direction = 0;     // +1: approached in the + sense, -1: in the - sense, 0: unknown
  int run = 1;           // pass over the targets
  double deviation = 0;  // actual - nominal; m, rad
};

// Each reading becomes a point of a run.
inline constexpr std::size_t kMostImportedReadings = 50'000;

struct ImportedSeries {
  std::string format;  // "csv", "iso230-2", "rtl"
  std::string source;  // file name, for messages
  std::string sha256;  // hash of the bytes of the file
  bool simulated = false;
  std::vector<ImportedReading> readings;
  // Statements of the file about itself: machine, date, operator.
  std::vector<std::string> about;
  Notices notices;  // changes that were made to the data when they were read
};

// The sense of a deviation along the axis. command: actual minus commanded position in the
// controller's coordinates. body: along + of the machine. Their signs differ if the body moves
// along - when the command increases. Positions are commands in both.
enum class PositioningSense { command, body };
struct ImportedSense {
  PositioningSense sense = PositioningSense::command;
  std::optional<bool> against_command;  // true: travel "-"; empty: not stated at the import
};
// The sense of every compensation table, for any sense of its runs.
inline constexpr PositioningSense kTablePositioningSense = PositioningSense::command;
const char* to_string(PositioningSense sense);  // "command", "body"
std::optional<PositioningSense> positioning_sense_from(std::string_view word);

// The error of an imported run.
ImportedError imported_run_error(const RunHeader& run);
// The deviation of a point of an imported run, in m or rad; NaN: the point has no deviation.
double deviation(const MeasuredPoint& point);
double deviation_uncertainty(const MeasuredPoint& point);

bool is_imported(const RunHeader& run);
// Error (bad_input): the run is imported and lacks the data that `what` needs.
Status check_measured(const RunHeader& run, const std::string& what);

}  // namespace mdof
