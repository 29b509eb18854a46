// Errors of an axis that were measured with another instrument: the series in a file, and the run
// that is stored from this series.
//
// An imported run has the axis, the file with its hash, and a point for each reading. It has no
// rig, and the `errors` of its points are not solved. `probe_m` of a point is the deviation (m or
// rad, actual - nominal), and `probe_u_m` is the declared standard uncertainty of the deviation
// (empty: not declared). The `model` of the run is the name of the error.
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

// Returns the name of the positioning error: "EXX" for X.
std::string positioning_name(Axis axis);

// One of the six errors of an axis.
struct ImportedError {
  std::string name;                  // "EXX"
  std::optional<std::size_t> named;  // index in error_names(); empty: positioning
  bool angle = false;
  std::string key() const { return name + (angle ? "_urad" : "_um"); }
};
// Error (usage): the axis has no such error; the message states the errors of the axis.
Result<ImportedError> imported_error(Axis axis, const std::string& name);

// A reading. Readings are in the order of the file.
struct ImportedReading {
  double position_m = 0;
  int direction = 0;     // direction of approach: +1, -1; 0: unknown
  int run = 1;           // number of the pass over the targets
  double deviation = 0;  // actual - nominal; m, rad
};

// Largest number of readings in a file, because each reading becomes a point of a run.
inline constexpr std::size_t kMostImportedReadings = 50'000;

struct ImportedSeries {
  std::string format;  // "csv", "iso230-2", "rtl"
  std::string source;  // file name, for messages
  std::string sha256;  // hash of the bytes of the file
  bool simulated = false;
  std::vector<ImportedReading> readings;
  // Statements of the file about itself: machine, date, operator.
  std::vector<std::string> about;
  Notices notices;  // changes of the data that were made when the file was read
};

// The sign of a positioning deviation.
// - command: actual minus commanded position in the coordinates of the controller
// - body: the deviation is positive if the body is too far in the + direction of the machine
//
// The two signs differ if the body moves in the - direction of the machine when the command
// increases. With both signs, the positions are commands.
enum class PositioningSense { command, body };
struct ImportedSense {
  PositioningSense sense = PositioningSense::command;
  // true: the body moves in the - direction when the command increases (travel "-"); empty: not
  // stated at the import.
  std::optional<bool> against_command;
};
// All compensation tables have this sense, whatever the sense of their runs.
inline constexpr PositioningSense kTablePositioningSense = PositioningSense::command;
const char* to_string(PositioningSense sense);  // "command", "body"
std::optional<PositioningSense> positioning_sense_from(std::string_view word);

// Returns which error an imported run contains.
ImportedError imported_run_error(const RunHeader& run);
// Returns the deviation of a point of an imported run, m or rad; NaN: the point has no deviation.
double deviation(const MeasuredPoint& point);
double deviation_uncertainty(const MeasuredPoint& point);

bool is_imported(const RunHeader& run);
// Error (bad_input): the run is imported, so it has no data for `what`.
Status check_measured(const RunHeader& run, const std::string& what);

}  // namespace mdof
