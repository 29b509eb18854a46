// A test report of stored runs in the form of PTB's Digital Calibration Certificate 3.3.0 with
// D-SI 2.2.1. It says that it is no calibration certificate of an accredited laboratory. Pure: the
// same results give the same bytes.
//
// Values are SI (metre, radian), with the expanded uncertainty U, its k and 95 % where U is known;
// NaN stands for what is not known. Points are lists by row, the figures of a run single
// quantities. What nobody stated reads "not stated" where the schema takes it.
#pragma once

#include <string>

#include "daemon/output/report/report.h"
#include "schema/base/result.h"

namespace mdof::documents {

// Error (bad_input): a key that the schema requires is not stated: country, or the date of a run
// whose log has none; a run is an imported one.
Result<std::string> dcc_xml(const report::Report& report);

}  // namespace mdof::documents
