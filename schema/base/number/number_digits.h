// The digits of eight doubles at once, for schema/base/number/number_write.cpp.
#pragma once

#include <cstdint>

#include "schema/base/instruction_set.h"

namespace mdof {

// x = d.ddd... · 10^exponent with 17 digits, rounded to nearest.
struct EightDigits {
  std::uint64_t first[8];  // 1 ... 9
  // the next eight digits: one byte (0 ... 9) for each digit, the first digit in the lowest byte
  std::uint64_t upper[8];
  std::uint64_t lower[8];  // the last eight digits, in the same form
  std::int64_t exponent[8];
};

// Bit i of the result is set if the digits of x[i] are not certain; the caller must then find them
// with the slow method. This is so if |x[i]| is not between 1e-98 and 1e7, if x[i] rounds up to a
// power of ten, or if the rounding of the 17th digit is not certain.
using FindDigits = unsigned (*)(const double* x, EightDigits& digits);

// Returns the function with the widest vectors that `most` and the processor allow; nullptr if no
// vectors are allowed.
FindDigits find_digits(InstructionSet most);

}  // namespace mdof
