// Converts values to texts for a report.
#pragma once

#include <string>

#include "daemon/output/charts/labels.h"

namespace mdof::report {

using charts::uncertainty_text;
using charts::value_text;
std::string value_with_u(double value, double u);  // "0.123 ± 0.045"
std::string key_unit(const std::string& key);      // "EYX_um": "µm"

}  // namespace mdof::report
