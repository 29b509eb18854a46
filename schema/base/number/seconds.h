// Converts decimal text in seconds to nanoseconds.
#pragma once

#include <cstdint>
#include <string_view>

namespace mdof {

// The result is rounded to the nearest nanosecond, even if a double cannot represent the time so
// exactly. Returns false if the text is not a number, or is beyond ±9.2e9 s.
bool parse_seconds(std::string_view field, std::int64_t& time_ns);

}  // namespace mdof
