// Reads MAX_ACCELERATION of the joints that a COMP_FILE corrects from the user's ini file.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/result.h"

namespace mdof::tools {

// Returns one ramp (MAX_ACCELERATION and SERVO_PERIOD) for each joint in `joints` that exists in
// the ini file. If `joints` is empty, the joints 0, 1, 2 are X, Y, Z. If the file does not set
// SERVO_PERIOD, it is 1 ms, LinuxCNC's default. Errors (bad_input; the message names file and key):
// the file cannot be read; LINEAR_UNITS contradicts `inch`; a value is missing or not above 0.
Result<std::vector<controllers::ExportOptions::Ramp>> read_joint_ramps(
    const std::string& file, const std::vector<controllers::ExportOptions::Joint>& joints,
    bool inch);

}  // namespace mdof::tools
