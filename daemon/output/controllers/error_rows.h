// File formats that contain the error itself instead of the correction. Each file is for one axis:
// - Weihong's axeserr.dat: one value for each approach
// - Beckhoff's lead screw tables: one value for each approach, rounded to 0.1 µm
// - Siemens' encoder error table: one value for both approaches, points at equal steps
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// axeserr.dat: a line "[X]", then rows of nominal position, forward error and backward error in mm.
// The manual does not state the sign; its example shows that the value is + E (E = actual -
// nominal).
Result<Export> write_weihong(const std::vector<CompensationTable>& tables,
                             const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_weihong(const std::vector<ControllerFile>& files);

// kw.ssfk: actual position - set position in 0.1 µm, one value for travel in the positive direction
// and one for the negative direction. At most 1499 rows: kw_nr_max must be less than the 1500 rows
// that the controller reserves by default (P-COMP-00059).
Result<Export> write_ssfk(const std::vector<CompensationTable>& tables,
                          const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_ssfk(const std::vector<ControllerFile>& files);

// $AA_ENC_COMP: the value is + E, because the control moves the axis in the negative direction if
// the value is positive. A file has one value for both approaches: the mean of the errors of the
// two approaches. At most 200 points at equal steps.
Result<Export> write_lec(const std::vector<CompensationTable>& tables,
                         const ExportOptions& options);
Result<std::vector<AppliedCorrection>> read_lec(const std::vector<ControllerFile>& files);

// The three formats use this function. Returns the positioning error of a table, fitted to `most`
// points (fitted() in series.h). Adds the names of the other errors to out.left_out.
Result<Series> positioning_of(const CompensationTable& table, std::size_t most,
                              const ExportOptions& options, const std::string& controller,
                              Export& out);

}  // namespace mdof::controllers
