// Errors of an axis that another instrument measured: a series that was read from a file, and the
// stored run that it became.
//
// An imported run has the axis, the file with its hash, and a point for each reading; no rig, and
// no solved errors: `probe_m` of its point is the one deviation (actual - nominal, m or rad), and
// `probe_u_m` its declared standard uncertainty (empty: none declared). Its `model` is the error's
// name.
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

// 'E', direction and axis: "EXX" of X.
std::string positioning_name(Axis axis);

// One of the six errors of an axis.
struct ImportedError {
  std::string name;                  // "EXX"
  std::optional<std::size_t> named;  // its place among error_names(); none: positioning
  bool angle = false;
  std::string key() const { return name + (angle ? "_urad" : "_um"); }
};
// Error (usage): it is none of this axis; names those there are.
Result<ImportedError> imported_error(Axis axis, const std::string& name);

// In the order of the file.
struct ImportedReading {
  double position_m = 0;
  int direction = 0;     // +1: approached in the + sense, -1: in the - sense, 0: not said
  int run = 1;           // pass over the targets
  double deviation = 0;  // actual - nominal; m, rad
};

// Each becomes a point of a run.
inline constexpr std::size_t kMostImportedReadings = 50'000;

struct ImportedSeries {
  std::string format;  // "csv", "iso230-2", "rtl"
  std::string source;  // file name, for messages
  std::string sha256;  // of the file's bytes
  bool simulated = false;
  std::vector<ImportedReading> readings;
  std::vector<std::string> about;  // what the file says of itself: machine, date, who
  Notices notices;                 // what of it was not read as it stands
};

// The sense of a deviation along the axis: of the command, the actual less the commanded place in
// the controller's coordinates, or of the body, along + of the machine. They differ by their sign
// where the body goes along - as the command grows. Positions are commands in both.
enum class PositioningSense { command, body };
struct ImportedSense {
  PositioningSense sense = PositioningSense::command;
  std::optional<bool> against_command;  // travel "-"; none: not said at the import
};
// That of every compensation table, whatever the sense of its runs.
inline constexpr PositioningSense kTablePositioningSense = PositioningSense::command;
const char* to_string(PositioningSense sense);  // "command", "body"
std::optional<PositioningSense> positioning_sense_from(std::string_view word);

// Of an imported run.
ImportedError error_of_imported(const RunHeader& run);
// Of a point of an imported run, in m or rad; NaN: the point has no deviation.
double deviation(const MeasuredPoint& point);
double u_of_deviation(const MeasuredPoint& point);

bool is_imported(const RunHeader& run);
// Error (bad_input): the run is an imported one, which has not what `what` needs.
Status check_measured(const RunHeader& run, const std::string& what);

}  // namespace mdof
