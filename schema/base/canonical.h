// Converts values to the bytes that are hashed. These bytes are the same on every machine and do
// not depend on how the values are displayed.
//   i  8-byte little-endian integer
//   d  8-byte little-endian IEEE 754, every NaN as 0x7ff8000000000000
//   s  the length as i, then the bytes
#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "schema/base/bytes.h"

namespace mdof::canonical {

inline void put(std::string& to, std::int64_t x) {
  put_number(to, x);
}
inline void put(std::string& to, std::uint64_t x) {
  put_number(to, x);
}
inline void put(std::string& to, int x) {
  put_number(to, std::int64_t{x});
}
inline void put(std::string& to, double x) {
  constexpr double kNaN = std::bit_cast<double>(std::uint64_t{0x7ff8000000000000});
  put_number(to, std::isnan(x) ? kNaN : x);
}
inline void put(std::string& to, std::span<const double> values) {
  for (const double x : values) put(to, x);
}
inline void put(std::string& to, std::string_view text) {
  put(to, std::uint64_t{text.size()});
  to.append(text);
}

// Appends the number of values as i, then each value as d.
inline void put_counted(std::string& to, std::span<const double> values) {
  put(to, std::uint64_t{values.size()});
  put(to, values);
}

}  // namespace mdof::canonical
