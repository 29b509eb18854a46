// Siemens' CEC (cross error compensation): one axis is corrected by the position of any axis, so
// that straightness reaches the machine as well as positioning.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// $AN_CEC: value = what is added to the command of the output axis, in mm. A table of the control
// has one error; two where the approaches differ (DIRECTION 1 and -1). One file.
Result<Export> write_cec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_cec(const std::vector<ControllerFile>& files);

// A volumetric table: tables by one axis that add up, and products of two (MULT_BY_TABLE: angles
// with their levers), whose factors are two tables. What sums of these cannot hold is left, and
// said. Error (bad_input): more commands along an axis than a table has points; unequal steps.
Result<Export> write_cec_volume(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_cec_volume(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
