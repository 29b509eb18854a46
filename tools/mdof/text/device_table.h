// The devices of mdofd as text.
#pragma once

#include <string>
#include <string_view>

namespace mdof::tools {

// Formats the reply to device.list: a table with state and counts of each device; then, for each
// device, its present faults, or otherwise its last fault. A line has at most `columns` characters.
std::string device_table(std::string_view device_list, std::size_t columns);

}  // namespace mdof::tools
