// What schema/base/number/number_columns.cpp does several fields at a time where the processor can.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/base/instruction_set.h"
#include "schema/base/number/number_columns.h"

namespace mdof {

// Read fields in groups; give the number read. It ends before the first group with a field that is
// not [-]ddd.ddd of at most 32 characters, a digit last, and 19 digits that matter, or whose
// rounding would take a closer look.
struct PlainReaders {
  std::size_t (*doubles)(const ColumnText& column, std::size_t n, double* out);
  std::size_t (*times_ns)(const ColumnText& column, std::size_t n, std::int64_t* out);
};

// The widest of at most this set that the processor has; without vectors, readers that read none.
PlainReaders plain_readers(InstructionSet most);

}  // namespace mdof
