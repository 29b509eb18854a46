// "00 01 0A" <-> bytes, for tests.
#pragma once

#include <string>
#include <string_view>

namespace mdof::drivers {

inline std::string bytes_of(std::string_view hex) {
  std::string digits, bytes;
  for (const char c : hex)
    if (c != ' ') digits += c;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return bytes;
}

}  // namespace mdof::drivers
