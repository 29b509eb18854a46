// Where the fields of CSV text end: found many bytes at a time, so that fields can be read without
// waiting for the end of the one before.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "schema/base/instruction_set.h"

namespace mdof {

// All bytes below '-' (as signed numbers): ',', LF, CR and what has no business in a row of plain
// numbers (space, '#', '+', '"', bytes beyond ASCII). Field k of the text is
// [at[k] + 1, at[k + 1]), for which at[0] is -1 (mod 2^32).
struct CsvStops {
  std::size_t count = 0;
  std::unique_ptr<std::uint32_t[]> at;
  std::unique_ptr<char[]> byte;  // [k]: the byte at at[k]; [0]: LF
  std::size_t room = 0;          // of both; memory never touched costs nothing
};

// Replaces `stops` with those of the text, which is below 4 GiB; reads up to kStopsMargin bytes
// behind it.
inline constexpr int kStopsMargin = 64;
void find_stops(std::string_view text, CsvStops& stops,
                InstructionSet set = best_instruction_set());

}  // namespace mdof
