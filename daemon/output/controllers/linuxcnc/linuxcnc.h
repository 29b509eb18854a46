// LinuxCNC: a COMP_FILE for each joint, and the lines for the ini file. According to source and
// experiments with 2.9, type 1 contains trims that are added unchanged to the motor command, looked
// up at the joint's uncompensated command: column 2 while the command increases, column 3 while it
// decreases. The parser silently ends the table at a line that it does not understand, so the file
// contains rows only.
#pragma once

#include <string_view>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

Result<Export> write_linuxcnc(const std::vector<CompensationTable>& tables,
                              const ExportOptions& options);
// Reads the ini lines and their tables, by a grammar that is stricter than LinuxCNC's.
Result<std::vector<AppliedCorrection>> read_linuxcnc(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
