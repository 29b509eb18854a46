// Converts bytes in the notation of manuals, such as "01 04 3F800000".
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace mdof::drivers::modbus {

inline std::string bytes(std::string_view hex) {
  std::string digits, result;
  for (const char c : hex)
    if (std::isxdigit(static_cast<unsigned char>(c)) != 0) digits += c;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    result += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return result;
}

}  // namespace mdof::drivers::modbus
