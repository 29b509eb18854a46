// mdof's own JSON format. It contains the complete table; all other formats contain a part of the
// table.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Writes {"format", "version", "marks", "table": {...}}. The hash of the table is the hash of the
// text of the member "table".
Result<Export> write_table_json(const std::vector<CompensationTable>& tables,
                                const ExportOptions& options);
// Returns a correction for each error whose factor is known: the error times this factor.
Result<std::vector<AppliedCorrection>> read_table_json(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
