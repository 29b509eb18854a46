// Vectorised part of schema/base/number/number_columns.cpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/base/instruction_set.h"
#include "schema/base/number/number_columns.h"

namespace mdof {

// These functions read fields in groups and return the number of fields that they have read. They
// stop before the first group that contains a field of another kind. A field must be [-]ddd.ddd
// with at most 32 characters and 19 significant digits, and must end in a digit. They also stop if
// the fast calculation cannot round a number with certainty.
struct PlainReaders {
  std::size_t (*doubles)(const ColumnText& column, std::size_t n, double* out);
  std::size_t (*times_ns)(const ColumnText& column, std::size_t n, std::int64_t* out);
};

// Returns the readers with the widest vectors that `most` and the processor allow. If no vectors
// are allowed, returns readers that read no field.
PlainReaders plain_readers(InstructionSet most);

}  // namespace mdof
