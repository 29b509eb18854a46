// Siemens' CEC (cross error compensation). The position of any axis can correct the same or another
// axis. CEC can therefore correct straightness as well as positioning.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// $AN_CEC: the control adds the value, in mm, to the command of the output axis. The result is one
// file. It contains one CEC table for each error, or two (DIRECTION 1 and -1) if the approaches
// differ.
Result<Export> write_cec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_cec(const std::vector<ControllerFile>& files);

// Converts a volumetric table to a sum of CEC tables: tables that depend on one axis, and products
// of two such tables (MULT_BY_TABLE, for an angle and its lever arm). Export::left_m is the
// remainder that this sum cannot represent. Errors (bad_input): more nodes along an axis than a CEC
// table has points; unequal steps.
Result<Export> write_cec_volume(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_cec_volume(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
