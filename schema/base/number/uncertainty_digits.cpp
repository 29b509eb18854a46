#include "schema/base/number/uncertainty_digits.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string_view>

namespace mdof {

int uncertainty_decimals(double u) {
  constexpr int kMostDecimals = 9;
  char buffer[32];
  const auto end =
      std::to_chars(buffer, buffer + sizeof buffer, u, std::chars_format::scientific, 1);
  const std::string_view text(buffer, static_cast<std::size_t>(end.ptr - buffer));
  const std::string_view exponent = text.substr(text.find('e') + 1);
  int size = 0;  // std::from_chars reads no plus sign
  std::from_chars(exponent.data() + 1, end.ptr, size);
  return std::min(1 - (exponent.front() == '-' ? -size : size), kMostDecimals);
}

double rounded_to_tens(double x, int decimals) {
  if (decimals >= 0) return x;
  const double place = std::pow(10.0, -decimals);
  return std::round(x / place) * place;
}

}  // namespace mdof
