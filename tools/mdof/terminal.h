// How wide what people read may be.
#pragma once

#include <cstddef>
#include <string_view>

namespace mdof::tools {

inline constexpr std::size_t kUsualColumns = 80;

// Of the terminal that the standard output is: COLUMNS, else what the terminal says, else 80. A
// pipe or a file has 80, or more where COLUMNS says so.
std::size_t terminal_columns();

// Characters, not bytes.
std::size_t text_width(std::string_view utf8);

}  // namespace mdof::tools
