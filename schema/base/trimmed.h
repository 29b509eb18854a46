// Text without the spaces around it.
#pragma once

#include <cstddef>
#include <string_view>

namespace mdof {

// Without spaces, tabs and carriage returns at both ends.
inline std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace mdof
