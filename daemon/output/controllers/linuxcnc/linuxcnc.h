// LinuxCNC: a COMP_FILE for each joint, and the lines of the ini file. Of source and experiment
// with 2.9: type 1 holds trims that are added to the motor command as they stand, looked up at the
// joint's uncompensated command; column 2 while it goes up, column 3 while it goes down. What its
// parser does not understand ends the table without a word, so that nothing but rows is written.
#pragma once

#include <string_view>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

Result<Export> write_linuxcnc(const std::vector<CompensationTable>& tables,
                              const ExportOptions& options);
// The ini lines and the tables that they name, by a grammar stricter than LinuxCNC's.
Result<std::vector<AppliedCorrection>> read_linuxcnc(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
