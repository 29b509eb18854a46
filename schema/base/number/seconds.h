// Converts decimal text in seconds to nanoseconds.
#pragma once

#include <cstdint>
#include <string_view>

namespace mdof {

// Exact to the nearest nanosecond, also for times at which a double has a coarser resolution.
// False: not a number, or beyond ±9.2e9 s.
bool parse_seconds(std::string_view field, std::int64_t& time_ns);

}  // namespace mdof
