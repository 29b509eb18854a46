// The calibration record that a command has made: its dates, its file.
#pragma once

#include <string>

#include "schema/base/result.h"
#include "schema/calibration/record.h"
#include "schema/rig/rig.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct RecordOptions {
  std::string out, date;  // date empty: of the log, else today's
  int valid_days = 365;
};
void add_record_options(CLI::App& command, RecordOptions& options);
// Those without --date.
void add_record_file_options(CLI::App& command, RecordOptions& options);

// "A, B, C".
std::string probe_ids(const Rig& rig);

// A record of this rig without probes; `started_utc` of the newest log, or empty. Error: no date.
Result<CalibrationRecord> begin_record(const std::string& kind, const Rig& rig,
                                       const RecordOptions& options,
                                       const std::string& started_utc);

// Error: the file is there already: a record is never changed.
Status write_record(const std::string& file, const std::string& text);

// What a motion of the target along this axis may touch, as a sentence before one that asks for it.
std::string hazard_of(const Rig& rig, Axis axis);

// Key of the rig's offset for a zero that was found: a gap's raw reading counts the other way.
double offset_um_with(const Probe& probe, double zero_m);

}  // namespace mdof::tools
