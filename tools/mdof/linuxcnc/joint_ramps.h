// MAX_ACCELERATION of the joints that a COMP_FILE corrects, as the user's ini file has it.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/base/result.h"

namespace mdof::tools {

// Of each joint of `joints` (empty: 0, 1, 2 are X, Y, Z) that the ini file has. SERVO_PERIOD is
// LinuxCNC's default of 1 ms where the file has none. Errors (bad_input), with file and key: those
// of reading; LINEAR_UNITS other than `inch` says; a value that is missing or not above 0.
Result<std::vector<controllers::ExportOptions::Ramp>> read_joint_ramps(
    const std::string& file, const std::vector<controllers::ExportOptions::Joint>& joints,
    bool inch);

}  // namespace mdof::tools
