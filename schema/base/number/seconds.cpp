#include "schema/base/number/seconds.h"

#include <algorithm>
#include <cmath>

#include "schema/base/number/number.h"

namespace mdof {
namespace {

constexpr double kMaxSeconds = 9.2e9;
constexpr double kNsInOneSecond = 1e9;

}  // namespace

bool parse_seconds(std::string_view field, std::int64_t& time_ns) {
  double seconds = 0;
  const char* const end = field.data() + field.size();
  if (field.empty() || parse_double(field.data(), end, seconds) != end) return false;
  if (!(std::abs(seconds) < kMaxSeconds)) return false;
  if (field.find_first_not_of("-.0123456789") != field.npos) {  // the field has an exponent
    time_ns = std::llround(seconds * kNsInOneSecond);
    return true;
  }
  const std::size_t sign = field[0] == '-';
  const std::size_t point = std::min(field.find('.'), field.size());
  std::int64_t ns = 0;
  for (const char c : field.substr(sign, point - sign)) ns = ns * 10 + (c - '0');
  for (std::size_t i = point + 1; i <= point + 9; ++i)
    ns = ns * 10 + (i < field.size() ? field[i] - '0' : 0);
  if (point + 10 < field.size() && field[point + 10] >= '5') ++ns;
  time_ns = sign ? -ns : ns;
  return true;
}

}  // namespace mdof
