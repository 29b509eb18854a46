// Finds the positions at which the fields of a CSV text end, many bytes at a time. The fields can
// then be read independently of each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "schema/base/instruction_set.h"

namespace mdof {

// The stops of a text. A stop is a byte that, as a signed number, is less than '-': ',', LF, CR,
// and the bytes that do not occur in a row of plain numbers (space, '#', '+', '"', bytes beyond
// ASCII). Field k of the text is [at[k] + 1, at[k + 1]). at[0] is -1 (mod 2^32).
struct CsvStops {
  std::size_t count = 0;
  std::unique_ptr<std::uint32_t[]> at;
  std::unique_ptr<char[]> byte;  // byte[k]: the byte at position at[k]; byte[0]: LF
  // Number of allocated elements of `at` and of `byte`. Elements that were never written need no
  // RAM.
  std::size_t room = 0;
};

// Finds the stops of the text; the memory of `stops` is reused. The text must be shorter than 4
// GiB; kStopsMargin bytes after its end must be readable.
inline constexpr int kStopsMargin = 64;
void find_stops(std::string_view text, CsvStops& stops,
                InstructionSet set = best_instruction_set());

}  // namespace mdof
