// Decimal text of seconds to nanoseconds.
#pragma once

#include <cstdint>
#include <string_view>

namespace mdof {

// To the nearest nanosecond, exactly; also times of which a double would lose the nanoseconds.
// False: not a number, or beyond ±9.2e9 s.
bool parse_seconds(std::string_view field, std::int64_t& time_ns);

}  // namespace mdof
