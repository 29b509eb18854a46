#include "tools/mdof/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

// Tables need at least kFewestColumns.
constexpr std::size_t kFewestColumns = 40, kMostColumns = 10'000;

// The value of the variable COLUMNS; 0: it is not set or invalid.
std::size_t stated_columns() {
  const char* text = std::getenv("COLUMNS");
  const std::string_view digits = text ? text : "";
  std::size_t columns = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), columns);
  return error == std::errc() && end == digits.data() + digits.size() ? columns : 0;
}

std::size_t columns_of_terminal(int file) {
  winsize size{};
  if (::ioctl(file, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return kUsualColumns;
  return size.ws_col;
}

}  // namespace

std::size_t terminal_columns() {
  const std::size_t stated = stated_columns();
  const std::size_t columns = !out_is_terminal() ? std::max(stated, kUsualColumns)
                              : stated > 0       ? stated
                                                 : columns_of_terminal(STDOUT_FILENO);
  return std::clamp(columns, kFewestColumns, kMostColumns);
}

std::size_t message_columns() {
  const std::size_t stated = stated_columns();
  return std::clamp(stated > 0 ? stated : columns_of_terminal(STDERR_FILENO), kFewestColumns,
                    kMostColumns);
}

}  // namespace mdof::tools
