// The devices of mdofd as people read them.
#pragma once

#include <string>
#include <string_view>

namespace mdof::tools {

// Of the answer to device.list, in lines of at most `columns` characters: a table of the states and
// counts, then what is wrong with whom, then what was and is over.
std::string device_table(std::string_view device_list, std::size_t columns);

}  // namespace mdof::tools
