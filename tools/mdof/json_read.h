// Members of what the daemon says, with a fallback where one is missing or of another kind.
#pragma once

#include <simdjson.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::tools {

template <class Json>
double number(const Json& of, std::string_view key) {
  double x = 0;
  return of.at_key(key).get_double().get(x) ? std::numeric_limits<double>::quiet_NaN() : x;
}

template <class Json>
std::optional<std::int64_t> integer(const Json& of, std::string_view key) {
  std::int64_t n = 0;
  if (of.at_key(key).get_int64().get(n)) return std::nullopt;
  return n;
}

template <class Json>
std::string text(const Json& of, std::string_view key) {
  std::string_view found;
  return of.at_key(key).get_string().get(found) ? "" : std::string(found);
}

template <class Json>
bool flag(const Json& of, std::string_view key) {
  bool found = false;
  return !of.at_key(key).get_bool().get(found) && found;
}

}  // namespace mdof::tools
