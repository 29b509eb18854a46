// Of what the sentences about a run are made.
#pragma once

#include <array>
#include <cstdio>
#include <string>
#include <vector>

namespace mdof::algo {

using Texts = std::vector<std::string>;

// `format` as of printf, with one number.
inline std::string with_number(const char* format, double x) {
  std::array<char, 64> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, x);
  return buffer.data();
}

}  // namespace mdof::algo
