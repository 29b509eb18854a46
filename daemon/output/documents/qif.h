// Results of stored runs as a QIF 3.0 document (ANSI/DMSC QIF 3.0, ISO 23952:2020). Pure: the same
// results give the same bytes.
//
// Each figure of a run, and each error at each target and approach, is a user-defined
// characteristic in µm or µrad; a measured point has five of them, one for each error.
// combinedUncertainty is the standard uncertainty u; its attribute meanError is 0, because known
// systematic errors have been corrected. The attributes U, k and coverage_probability state the
// expanded uncertainty. A point without errors has no value; its description gives the reason.
#pragma once

#include <string>

#include "daemon/output/report/report.h"
#include "schema/base/result.h"

namespace mdof::documents {

// Error (bad_input): an imported run.
Result<std::string> qif_xml(const report::Report& report);

}  // namespace mdof::documents
