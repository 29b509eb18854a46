// A test report of stored runs in the form of PTB's Digital Calibration Certificate 3.3.0 with D-SI
// 2.2.1. It states that it is no calibration certificate of an accredited laboratory. Pure: the
// same results give the same bytes.
//
// Values are in SI units (metre, radian). If the expanded uncertainty U is known, the document
// states U, k and the coverage probability 95 %. NaN means unknown. The points of a run are lists
// of values; each figure of a run is one quantity. If information is missing, the document contains
// the text "not stated" where the schema allows it.
#pragma once

#include <string>

#include "daemon/output/report/report.h"
#include "schema/base/result.h"

namespace mdof::documents {

// Error (bad_input): a required key of the schema is missing (country, or the date of a run whose
// log has no date); an imported run.
Result<std::string> dcc_xml(const report::Report& report);

}  // namespace mdof::documents
