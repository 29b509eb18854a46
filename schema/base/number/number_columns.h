// Columns of plain decimal numbers from CSV text whose field ends are known
// (schema/base/csv/csv_stops.h).
#pragma once

#include <cstddef>
#include <cstdint>

#include "schema/base/instruction_set.h"

namespace mdof {

// Fields of one column in consecutive rows: field j is the text between stop[j stride] and
// stop[j stride + 1], both excluded. kColumnMargin bytes before the first field and after the last
// are readable.
struct ColumnText {
  const char* text;
  const std::uint32_t* stop;
  std::size_t stride;
};
inline constexpr int kColumnMargin = 64;

// Reads up to n fields. Returns the number of fields before the first that is not a finite decimal
// number. The results are the nearest doubles, as from parse_double(), on every processor.
std::size_t read_doubles(const ColumnText& column, std::size_t n, double* out,
                         InstructionSet set = best_instruction_set());
// The same for decimal seconds to nanoseconds, as from parse_seconds().
std::size_t read_times_ns(const ColumnText& column, std::size_t n, std::int64_t* out,
                          InstructionSet set = best_instruction_set());

}  // namespace mdof
