// Reads columns of plain decimal numbers from CSV text. The ends of the fields must already be
// known (schema/base/csv/csv_stops.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/base/instruction_set.h"

namespace mdof {

// The fields of one column in consecutive rows. Field j is the text between stop[j stride] and
// stop[j stride + 1]; both ends are excluded. kColumnMargin bytes before the first field and after
// the last field must be readable.
struct ColumnText {
  const char* text;
  const std::uint32_t* stop;
  std::size_t stride;
};
inline constexpr int kColumnMargin = 64;

// Reads up to n fields. Stops at the first field that is not a finite decimal number, and returns
// the number of fields before it. The results are the nearest doubles, as from parse_double(), on
// every processor.
std::size_t read_doubles(const ColumnText& column, std::size_t n, double* out,
                         InstructionSet set = best_instruction_set());
// As read_doubles(), but converts decimal seconds to nanoseconds, as parse_seconds() does.
std::size_t read_times_ns(const ColumnText& column, std::size_t n, std::int64_t* out,
                          InstructionSet set = best_instruction_set());

}  // namespace mdof
