// Converts decimal text to doubles and doubles to decimal text, exactly and several times faster
// than the standard library, for logs of 100 MB.
#pragma once

#include <cstddef>

#include "schema/base/instruction_set.h"

namespace mdof {

// Reads the longest number at `begin`: digits with an optional '-', '.' and exponent, or inf, nan;
// no leading space or '+'. The result is the nearest double (ties to even), with the same bits as
// std::from_chars. A number that is too large becomes ±inf, and a number that is too small becomes
// ±0. Therefore the caller needs only std::isfinite(). Returns the position after the number, or
// nullptr if there is no number.
const char* parse_double(const char* begin, const char* end, double& out);

// Writes x with 17 significant digits, the same characters as printf("%.17g"); returns the end. The
// text has at most kDouble17Size characters; the function may write to all of them.
inline constexpr int kDouble17Size = 40;
char* write_double_17(char* out, double x);

// The same for many numbers, eight at a time if the processor supports it: out[i] is the text of
// x[i].
struct DoubleText {
  char text[kDouble17Size];
  int size;
};
void write_doubles_17(const double* x, std::size_t n, DoubleText* out,
                      InstructionSet set = best_instruction_set());

}  // namespace mdof
