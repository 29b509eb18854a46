// The number of columns of the terminal, for wrapping text.
#pragma once

#include <cstddef>

namespace mdof::tools {

inline constexpr std::size_t kUsualColumns = 80;

// Width of the terminal of the standard output: COLUMNS, otherwise the width of the terminal,
// otherwise 80. For a pipe or a file: the larger number of COLUMNS and 80. The result is 40 to
// 10,000.
std::size_t terminal_columns();

// Width of the terminal of the standard error. Messages to other destinations are not wrapped.
std::size_t message_columns();

}  // namespace mdof::tools
