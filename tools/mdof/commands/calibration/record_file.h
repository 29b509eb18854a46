// Options and functions of commands that write a calibration record to a file.
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
// As add_record_options(), without --date.
void add_record_file_options(CLI::App& command, RecordOptions& options);

// The ids of the rig's probes: "A, B, C".
std::string probe_ids(const Rig& rig);

// Returns a record of this rig to which the caller adds the probes. `started_utc`: start time of
// the newest log, or empty. Errors: the date is invalid; the rig already uses a mounting record.
Result<CalibrationRecord> begin_record(const std::string& kind, const Rig& rig,
                                       const RecordOptions& options,
                                       const std::string& started_utc);

// Error: the file exists already. A record is never changed.
Status write_record(const std::string& file, const std::string& text);

// A sentence that warns of the probes that the target may touch if the target moves along this
// axis.
std::string clearance_warning(const Rig& rig, Axis axis);

// The new value of the key offset_um, µm: the present offset plus the measured zero of the probe.
// If the probe reads a gap, the zero is subtracted.
double new_offset_um(const Probe& probe, double zero_m);

}  // namespace mdof::tools
