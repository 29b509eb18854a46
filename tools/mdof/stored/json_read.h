// Reads members of JSON texts from mdofd. If a member is missing or has another type, the functions
// return NaN, nullopt or an empty value.
#pragma once

#include <simdjson.h>

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/notice/notice_json.h"

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

// The texts in an array; other elements are skipped.
template <class Json>
std::vector<std::string> texts(const Json& of, std::string_view key) {
  std::vector<std::string> found;
  simdjson::dom::array items;
  if (of.at_key(key).get_array().get(items)) return found;
  for (const simdjson::dom::element item : items) {
    std::string_view words;
    if (!item.get_string().get(words)) found.emplace_back(words);
  }
  return found;
}

// The member "notices"; empty if it cannot be read.
template <class Json>
Notices notices_of(const Json& of) {
  simdjson::dom::element list;
  if (of.at_key("notices").get(list)) return {};
  return read_notices(simdjson::minify(list)).value_or(Notices());
}

template <class Json>
bool flag(const Json& of, std::string_view key) {
  bool found = false;
  return !of.at_key(key).get_bool().get(found) && found;
}

}  // namespace mdof::tools
