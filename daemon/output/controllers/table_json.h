// mdof's own JSON with the complete table. All other formats contain a part of it.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// {"format", "version", "marks", "table": {...}}: `table` is the text of which the table's hash is
// made.
Result<Export> write_table_json(const std::vector<CompensationTable>& tables,
                                const ExportOptions& options);
// The errors that have a factor, each multiplied by it.
Result<std::vector<AppliedCorrection>> read_table_json(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
