#include "schema/base/number/number.h"

#include <system_error>

#include "schema/base/number/number_scan.h"

namespace mdof {

const char* parse_double(const char* begin, const char* end, double& out) {
  const auto [after, error] = fast_float::from_chars(begin, end, out);
  return error == std::errc() ? after : nullptr;
}

}  // namespace mdof
