// Values as a report prints them.
#pragma once

#include <string>

namespace mdof::report {

// U, u: two significant digits. A value: to the place of its uncertainty (GUM 7.2.6); four
// significant digits where there is none. In the unit of the key; what is not known is "–".
std::string uncertainty_text(double u);
std::string value_text(double value, double u);
std::string value_with_u(double value, double u);  // "0.123 ± 0.045"
std::string unit_of_key(const std::string& key);   // "EYX_um": "µm"

}  // namespace mdof::report
