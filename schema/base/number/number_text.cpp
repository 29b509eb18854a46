#include "schema/base/number/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace mdof {

std::string plain_number(double x, int digits) {
  if (!std::isfinite(x)) return "unknown";
  const double size = std::abs(x);
  if (size == 0) return "0";
  char text[64];
  if (size >= 1e15 || size < 1e-6) {
    std::snprintf(text, sizeof text, "%.*g", digits, x);
    return text;
  }
  const int before = static_cast<int>(std::floor(std::log10(size))) + 1;
  const int decimals = std::clamp(digits - before, 0, 15);
  std::snprintf(text, sizeof text, "%.*f", decimals, x);
  std::string number = text;
  if (decimals > 0) number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return number;
}

}  // namespace mdof
