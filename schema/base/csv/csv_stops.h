// Positions where the fields of CSV text end, found many bytes at a time, so that fields can be
// read independently of each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>

#include "schema/base/instruction_set.h"

namespace mdof {

// Positions of all bytes below '-' (as signed numbers): ',', LF, CR and bytes that do not belong in
// a row of plain numbers (space, '#', '+', '"', bytes beyond ASCII). Field k of the text is
// [at[k] + 1, at[k + 1]), where at[0] is -1 (mod 2^32).
struct CsvStops {
  std::size_t count = 0;
  std::unique_ptr<std::uint32_t[]> at;
  std::unique_ptr<char[]> byte;  // [k]: the byte at at[k]; [0]: LF
  std::size_t room = 0;          // allocated length of both; untouched memory uses no RAM
};

// Replaces `stops` by the stops of the text, which must be shorter than 4 GiB. Reads up to
// kStopsMargin bytes beyond its end.
inline constexpr int kStopsMargin = 64;
void find_stops(std::string_view text, CsvStops& stops,
                InstructionSet set = best_instruction_set());

}  // namespace mdof
