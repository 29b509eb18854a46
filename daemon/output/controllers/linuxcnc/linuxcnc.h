// LinuxCNC: a COMP_FILE for each joint, and the lines for the ini file.
// A COMP_FILE of type 1 contains trims. LinuxCNC finds the trim at the uncompensated command of the
// joint, and adds it unchanged to the motor command. Column 2 applies while the command increases,
// column 3 while it decreases (source code of LinuxCNC, and experiments with version 2.9).
// The file contains rows only and no comments, because the parser of LinuxCNC ends the table
// without a message at a line that it does not understand.
#pragma once

#include <string_view>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

Result<Export> write_linuxcnc(const std::vector<CompensationTable>& tables,
                              const ExportOptions& options);
// Reads the ini lines and the tables that they name. Returns an error for a line that LinuxCNC
// would skip.
Result<std::vector<AppliedCorrection>> read_linuxcnc(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
