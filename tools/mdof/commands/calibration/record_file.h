// The calibration record that a command writes: its dates and its file.
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
  std::string out, date;  // Empty `date`: the date of the log, otherwise today.
  int valid_days = 365;
};
void add_record_options(CLI::App& command, RecordOptions& options);
// The options without --date.
void add_record_file_options(CLI::App& command, RecordOptions& options);

// "A, B, C".
std::string probe_ids(const Rig& rig);

// A record of this rig without probes. `started_utc`: start of the newest log, or empty. Error:
// invalid date.
Result<CalibrationRecord> begin_record(const std::string& kind, const Rig& rig,
                                       const RecordOptions& options,
                                       const std::string& started_utc);

// Error: the file exists already, because a record is never changed.
Status write_record(const std::string& file, const std::string& text);

// A sentence that warns which probes a motion of the target along this axis may touch.
std::string clearance_warning(const Rig& rig, Axis axis);

// The key offset_um of the rig for a measured zero. If the probe reads a gap, the zero counts in
// the opposite sense.
double offset_for_zero_um(const Probe& probe, double zero_m);

}  // namespace mdof::tools
