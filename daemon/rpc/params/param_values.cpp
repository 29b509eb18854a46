#include "daemon/rpc/params/param_values.h"

#include <cmath>

#include "daemon/rpc/message.h"
#include "schema/base/toml/toml_reader.h"

namespace mdof::rpc {
namespace {

using simdjson::dom::element;
using simdjson::dom::element_type;

tl::unexpected<Error> usage(std::string message) {
  return fail(ErrorCode::usage, std::move(message));
}

const char* kind(const element& value) {
  switch (value.type()) {
    case element_type::ARRAY:
      return "an array";
    case element_type::OBJECT:
      return "an object";
    case element_type::STRING:
      return "a string";
    case element_type::BOOL:
      return "a boolean";
    case element_type::NULL_VALUE:
      return "null";
    default:
      return "a number";
  }
}

// Whether the value is an integer. 3.0 is an integer, as in JSON Schema. Doubles above 2^53 are not
// exact and not accepted.
bool is_integer(const element& value) {
  if (value.is_int64()) return true;
  double x = 0;
  return value.is_double() && value.get(x) == simdjson::SUCCESS && std::trunc(x) == x &&
         std::abs(x) <= 9007199254740992.0;
}

bool fits(const element& value, ParamType type) {
  switch (type) {
    case ParamType::string:
      return value.is_string();
    case ParamType::number:
      return value.is_number();
    case ParamType::integer:
      return is_integer(value);
    case ParamType::boolean:
      return value.is_bool();
    case ParamType::array:
      return value.is_array();
    case ParamType::object:
      return value.is_object();
  }
  return false;
}

std::string names(const Method& method) {
  std::string list;
  for (const Param& param : method.params) list += (list.empty() ? "" : ", ") + param.name;
  return list.empty() ? "none" : list;
}

std::optional<std::size_t> index_of(const Method& method, std::string_view name) {
  for (std::size_t i = 0; i < method.params.size(); ++i)
    if (method.params[i].name == name) return i;
  return std::nullopt;
}

tl::unexpected<Error> unknown_name(const Method& method, std::string_view name) {
  std::vector<std::string> known;
  for (const Param& param : method.params) known.push_back(param.name);
  const bool sane = name.size() <= 64;  // comparing long texts takes long and is useless
  const std::string near = sane ? nearest_candidate(name, known) : "";
  return usage("unknown parameter " + in_quotes(name) +
               (near.empty() ? "; the parameters of " + method.name + " are: " + names(method)
                             : "; did you mean " + in_quotes(near) + "?"));
}

std::string plain(double x) {
  return std::trunc(x) == x ? std::to_string(static_cast<std::int64_t>(x)) : std::to_string(x);
}

Status check_number(const Param& param, const element& value) {
  double x = 0;
  if (!value.is_number() || value.get(x) != simdjson::SUCCESS) return {};
  if (x >= param.bounds.least && x <= param.bounds.most) return {};
  return usage("parameter " + in_quotes(param.name) + " must be from " + plain(param.bounds.least) +
               " to " + plain(param.bounds.most));
}

Status check_array(const Param& param, const simdjson::dom::array& items) {
  std::size_t count = 0;  // counted here, because array.size() is at most 2^24
  for (const element item : items) {
    if (++count > param.bounds.items)
      return usage("parameter " + in_quotes(param.name) + " may have at most " +
                   std::to_string(param.bounds.items) + " elements");
    MDOF_CHECK(check_number(param, item));
  }
  return {};
}

Status check_bounds(const Param& param, const element& value) {
  simdjson::dom::array items;
  std::string_view text;
  if (value.get(items) == simdjson::SUCCESS) return check_array(param, items);
  if (value.get(text) == simdjson::SUCCESS && text.size() > param.bounds.bytes)
    return usage("parameter " + in_quotes(param.name) + " may have at most " +
                 std::to_string(param.bounds.bytes) + " bytes");
  return check_number(param, value);
}

Status set(const Method& method, std::size_t i, const element& value, ParamValues& out) {
  const Param& param = method.params[i];
  if (value.is_null() && !param.required) return {};
  if (!fits(value, param.type))
    return usage("parameter " + in_quotes(param.name) + " must be of type " +
                 to_string(param.type) + ", not " + kind(value) +
                 (param.type == ParamType::integer && value.is_number()
                      ? " with a fraction or with more than 64 bits"
                      : ""));
  MDOF_CHECK(check_bounds(param, value));
  out.values[i] = value;
  return {};
}

Status set_by_name(const Method& method, const simdjson::dom::object& params, ParamValues& out) {
  for (const auto [name, value] : params) {
    const auto i = index_of(method, name);
    if (!i) return unknown_name(method, name);
    if (out.values[*i]) return usage("parameter " + in_quotes(name) + " is given twice");
    MDOF_CHECK(set(method, *i, value, out));
  }
  return {};
}

Status set_by_position(const Method& method, const simdjson::dom::array& params, ParamValues& out) {
  std::size_t i = 0;
  for (const element value : params) {
    if (i == method.params.size())
      return usage(method.name + " takes at most " + std::to_string(i) +
                   " parameters by position: " + names(method));
    MDOF_CHECK(set(method, i++, value, out));
  }
  return {};
}

}  // namespace

Status check_params(const Method& method, const std::optional<element>& params, ParamValues& out) {
  out.method = &method;
  out.values.assign(method.params.size(), std::nullopt);
  simdjson::dom::object object;
  simdjson::dom::array array;
  if (params && params->get(object) == simdjson::SUCCESS) {
    MDOF_CHECK(set_by_name(method, object, out));
  } else if (params && params->get(array) == simdjson::SUCCESS) {
    MDOF_CHECK(set_by_position(method, array, out));
  }
  for (std::size_t i = 0; i < method.params.size(); ++i)
    if (const Param& param = method.params[i]; param.required && !out.values[i])
      return usage("parameter " + in_quotes(param.name) + " is missing (" + to_string(param.type) +
                   ": " + param.description + ")");
  return {};
}

}  // namespace mdof::rpc
