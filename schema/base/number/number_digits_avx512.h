// The digits of eight doubles at once, for schema/base/number/number_write.cpp.
#pragma once

#include <cstdint>

namespace mdof::avx512 {

// x = d.ddd... · 10^exponent with 17 digits, rounded to nearest.
struct EightDigits {
  std::uint64_t first[8];       // 1 ... 9
  std::uint64_t upper[8];       // the eight digits after it, as bytes 0 ... 9, first lowest
  std::uint64_t lower[8];       // the last eight
  std::int64_t significant[8];  // digits up to the last that is not 0
  std::int64_t exponent[8];
};

// Only where has_avx512(). Bit i of the result: x[i] is not decided here (its size is not between
// 1e-98 and 1e7, it rounds up to a power of ten, or its 18th digit is too near to a half).
unsigned find_digits(const double* x, EightDigits& digits);

}  // namespace mdof::avx512
