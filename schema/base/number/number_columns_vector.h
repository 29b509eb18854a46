// Vectorised part of schema/base/number/number_columns.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/base/instruction_set.h"
#include "schema/base/number/number_columns.h"

namespace mdof {

// Read fields in groups; return the number read. Reading ends before the first group with a field
// that is not [-]ddd.ddd of at most 32 characters, a digit last, and 19 significant digits, or
// whose rounding needs more than the fast calculation.
struct PlainReaders {
  std::size_t (*doubles)(const ColumnText& column, std::size_t n, double* out);
  std::size_t (*times_ns)(const ColumnText& column, std::size_t n, std::int64_t* out);
};

// The widest readers of at most this set that the processor supports; without vectors, readers that
// read nothing.
PlainReaders plain_readers(InstructionSet most);

}  // namespace mdof
