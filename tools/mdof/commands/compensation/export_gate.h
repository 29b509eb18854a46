// Checks whether the data of an export may be used in a controller. Each function returns an error
// if the request does not accept a warning. If the request accepts the warning, the function adds
// the warning to the files of the export.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/controllers/export.h"
#include "daemon/store/store.h"
#include "schema/base/result.h"
#include "tools/mdof/commands/compensation/exported.h"
#include "tools/mdof/linuxcnc/joint_settings.h"

namespace mdof::tools {

// Simulated or doubtful data.
Status judge(const daemon::Judged& judged, const ExportRequest& request, ExportedTables& out);
// A table that is not active. `generation`: 0 if the table is not active.
Status judge_active(std::int64_t table, std::int64_t generation, const ExportRequest& request,
                    std::vector<std::string>& marks);
// As above, for a table of an axis. Positioning errors are rejected while a volumetric table is
// active, which contains them too.
Status judge_table(store::Store& store, const CompensationTable& table,
                   const ExportRequest& request, ExportedTables& out);
// A format whose sign is not confirmed.
Status judge_sign(const controllers::Format& format, const ExportRequest& request,
                  std::vector<std::string>& marks);
// Corrections that the ini file of LinuxCNC already has. If they were in use during the
// measurement, the table does not contain the errors that they corrected, but LinuxCNC no longer
// applies them.
Status judge_present(const std::vector<JointSettings::Correction>& corrections,
                     const std::vector<CompensationTable>& tables, const ExportRequest& request,
                     std::vector<std::string>& marks);

}  // namespace mdof::tools
