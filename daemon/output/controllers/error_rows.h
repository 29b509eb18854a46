// Controllers whose files contain the error itself, one axis each: Weihong's axeserr.dat (both
// approaches), Beckhoff's lead screw tables (both approaches, whole 0.1 µm) and Siemens' encoder
// error table (one value, equidistant points).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// [X], rows of nominal position, forward error and backward error in mm. The sign + E is inferred
// from the example in the manual.
Result<Export> write_weihong(const std::vector<CompensationTable>& tables,
                             const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_weihong(const std::vector<ControllerFile>& files);

// kw.ssfk: actual - set position in 0.1 µm, positive and negative travel; at most 1500 rows.
Result<Export> write_ssfk(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_ssfk(const std::vector<ControllerFile>& files);

// $AA_ENC_COMP: a positive value moves the axis in the negative direction, so the value is + E.
// Both approaches have the same value, their mean. At most 200 points at equal steps.
Result<Export> write_lec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_lec(const std::vector<ControllerFile>& files);

// Common to the three formats: the fitted positioning of a table. The other errors are listed as
// left out.
Result<Series> positioning_of(const CompensationTable& table, std::size_t most,
                              const ExportOptions& options, const std::string& controller,
                              Export& out);

}  // namespace mdof::controllers
