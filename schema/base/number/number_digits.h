// The digits of eight doubles at once, for schema/base/number/number_write.cpp.
#pragma once

#include <cstdint>

#include "schema/base/instruction_set.h"

namespace mdof {

// x = d.ddd... · 10^exponent with 17 digits, rounded to nearest.
struct EightDigits {
  std::uint64_t first[8];  // 1 ... 9
  std::uint64_t upper[8];  // the eight digits after it, as bytes 0 ... 9, first lowest
  std::uint64_t lower[8];  // the last eight
  std::int64_t exponent[8];
};

// Bit i of the result: x[i] is undecided (its magnitude is not between 1e-98 and 1e7, it rounds up
// to a power of ten, or its 18th digit is too near to a half).
using FindDigits = unsigned (*)(const double* x, EightDigits& digits);

// With the widest vectors of at most this set that the processor supports; nullptr: none.
FindDigits find_digits(InstructionSet most);

}  // namespace mdof
