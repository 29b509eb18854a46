// mdof's own JSON: everything in the table, from which every other format is a projection.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// {"format", "version", "marks", "table": {...}}: `table` as the hash of the table has it.
Result<Export> write_table_json(const std::vector<CompensationTable>& tables,
                                const ExportOptions& options);
// Errors that have a factor, each times it.
Result<std::vector<AppliedCorrection>> read_table_json(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
