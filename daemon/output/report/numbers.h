// Converts values to texts for a report.
#pragma once

#include <string>

namespace mdof::report {

// U and u have two significant digits. A value is rounded to the last digit of its uncertainty (GUM
// 7.2.6), or to four significant digits if the uncertainty is unknown. The numbers are in the unit
// of the key. Unknown values are "–".
std::string uncertainty_text(double u);
std::string value_text(double value, double u);
std::string value_with_u(double value, double u);  // "0.123 ± 0.045"
std::string key_unit(const std::string& key);      // "EYX_um": "µm"

}  // namespace mdof::report
