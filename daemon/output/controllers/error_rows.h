// Controllers whose files hold the error itself, for one axis each: Weihong's axeserr.dat (both
// approaches), Beckhoff's lead screw tables (both, whole 0.1 µm) and Siemens' encoder error table
// (one value, on an equidistant grid).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// [X], rows nominal, forward error, backward error in mm; + E is inferred from the manual's
// example.
Result<Export> write_weihong(const std::vector<CompensationTable>& tables,
                             const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_weihong(const std::vector<ControllerFile>& files);

// kw.ssfk: actual - set in 0.1 µm, positive and negative travel; at most 1500 rows.
Result<Export> write_ssfk(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_ssfk(const std::vector<ControllerFile>& files);

// $AA_ENC_COMP: a positive value moves the axis in the negative direction, so that the value is +
// E. Both approaches have one value, their mean. At most 200 points at equal steps.
Result<Export> write_lec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_lec(const std::vector<ControllerFile>& files);

// What the three have in common: the positioning of a table, fitted; the others are named as left
// out.
Result<Series> positioning_of(const CompensationTable& table, std::size_t most,
                              const ExportOptions& options, const std::string& controller,
                              Export& out);

}  // namespace mdof::controllers
