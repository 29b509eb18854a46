// How wide what people read may be.
#pragma once

#include <cstddef>

namespace mdof::tools {

inline constexpr std::size_t kUsualColumns = 80;

// Of the terminal that the standard output is: COLUMNS, else what the terminal says, else 80. A
// pipe or a file has 80, or more where COLUMNS says so.
std::size_t terminal_columns();

// Of the terminal that the standard error is; messages that go elsewhere are not wrapped.
std::size_t message_columns();

}  // namespace mdof::tools
