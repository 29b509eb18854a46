// Numbers in messages for people: "5000", not "5e+03" or "5000.000000".
#pragma once

#include <string>

namespace mdof {

// `digits` significant digits without trailing zeros. An exponent only if it is shorter than the
// zeros: from 1e15 and below 1e-6. Zero has no sign; non-finite: "unknown".
std::string plain_number(double x, int digits = 4);

}  // namespace mdof
