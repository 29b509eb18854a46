// Converts doubles to the bytes of a database column, and back. Each double has 8 bytes (IEEE 754,
// little-endian).
#pragma once

#include <bit>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

namespace mdof::store {

static_assert(std::endian::native == std::endian::little, "stored doubles are little-endian bytes");

inline std::string_view bytes_of(std::span<const double> x) {
  return {reinterpret_cast<const char*>(x.data()), x.size_bytes()};
}

// Copies doubles from `bytes` to `x`. The number of copied doubles is the smaller one of the two
// sizes.
inline void doubles_from(std::string_view bytes, std::span<double> x) {
  const std::size_t n = std::min(x.size(), bytes.size() / sizeof(double));
  if (n > 0) std::memcpy(x.data(), bytes.data(), n * sizeof(double));
}

inline std::vector<double> doubles_from(std::string_view bytes) {
  std::vector<double> x(bytes.size() / sizeof(double));
  doubles_from(bytes, x);
  return x;
}

}  // namespace mdof::store
