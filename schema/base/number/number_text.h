// Text of numbers in messages for people: "5000", not "5e+03" or "5000.000000".
#pragma once

#include <string>

namespace mdof {

// Text with `digits` significant digits, without trailing zeros. From 1e15 and below 1e-6 it has an
// exponent, because the exponent is shorter than the zeros. Zero has no sign. A number that is not
// finite is "unknown".
std::string plain_number(double x, int digits = 4);

}  // namespace mdof
