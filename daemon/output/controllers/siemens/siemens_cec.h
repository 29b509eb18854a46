// Siemens' CEC (cross error compensation): the position of any axis can correct any other axis, so
// that straightness can be corrected as well as positioning.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// $AN_CEC: the value is added to the command of the output axis, in mm. A table of the control has
// one error; two tables if the approaches differ (DIRECTION 1 and -1). One file.
Result<Export> write_cec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_cec(const std::vector<ControllerFile>& files);

// A volumetric table: tables by one axis that add up, and products of two tables (MULT_BY_TABLE:
// angles with their lever arms). A remainder that these sums cannot represent is stated. Error
// (bad_input): more commands along an axis than a table has points; unequal steps.
Result<Export> write_cec_volume(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_cec_volume(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
