// The devices of mdofd as text.
#pragma once

#include <string>
#include <string_view>

namespace mdof::tools {

// Formats the answer to device.list in lines of at most `columns` characters: a table of states and
// counts, then the present faults of each device, or the last fault that has recovered.
std::string device_table(std::string_view device_list, std::size_t columns);

}  // namespace mdof::tools
