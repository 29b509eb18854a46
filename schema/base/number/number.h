// Decimal text to double and back, exact in both directions and several times faster than the
// standard library: 100 MB logs are read and written through these two.
#pragma once

#include <cstddef>

#include "schema/base/instruction_set.h"

namespace mdof {

// Reads the longest number at `begin`: digits with an optional '-', '.' and exponent, or inf, nan;
// no leading space or '+'. The double is the nearest one (ties to even), bit for bit that of
// std::from_chars; a number too large becomes ±inf, one too small ±0, so that the caller has one
// check: std::isfinite. Gives the position after the number, or nullptr where none begins.
const char* parse_double(const char* begin, const char* end, double& out);

// Writes x with 17 significant digits, the same characters as printf("%.17g"); gives the end.
// At most kDouble17Size characters; may touch all of them.
inline constexpr int kDouble17Size = 40;
char* write_double_17(char* out, double x);

// The same for many numbers, eight at a time where the processor can: out[i] is the text of x[i].
struct DoubleText {
  char text[kDouble17Size];
  int size;
};
void write_doubles_17(const double* x, std::size_t n, DoubleText* out,
                      InstructionSet set = best_instruction_set());

}  // namespace mdof
