// Where the fields of CSV text end: found sixteen bytes at a time, so that fields can be read
// without waiting for the end of the one before.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace mdof {

// Replaces `stops` with the positions of all bytes below '-': ',', LF, CR and what has no business
// in a row of plain numbers (space, '#', '+', '"'). Before them -1 (mod 2^32), so that field k of
// the text is [stops[k] + 1, stops[k + 1]). The text is below 4 GiB; reads up to kStopsMargin bytes
// behind it.
inline constexpr int kStopsMargin = 64;
void find_stops(std::string_view text, std::vector<std::uint32_t>& stops);

}  // namespace mdof
