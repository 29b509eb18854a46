#include "daemon/rpc/params/params.h"

#include <cassert>
#include <cmath>

#include "daemon/rpc/message.h"
#include "daemon/rpc/params/param_values.h"

namespace mdof::rpc {
namespace {

using simdjson::dom::element;

const element* find(const ParamValues& values, std::string_view name,
                    [[maybe_unused]] std::optional<ParamType> type) {
  const auto& params = values.method->params;
  for (std::size_t i = 0; i < params.size(); ++i) {
    if (params[i].name != name) continue;
    assert(!type || params[i].type == *type);
    return values.values[i] ? &*values.values[i] : nullptr;
  }
  assert(false && "the method has no parameter of this name");
  return nullptr;
}

bool read(const element& value, double& out) {
  return value.get(out) == simdjson::SUCCESS;
}

bool read(const element& value, std::int64_t& out) {
  if (value.get(out) == simdjson::SUCCESS) return true;
  double x = 0;
  if (value.get(x) != simdjson::SUCCESS || std::trunc(x) != x || std::abs(x) > 9007199254740992.0)
    return false;
  out = static_cast<std::int64_t>(x);
  return true;
}

bool read(const element& value, bool& out) {
  return value.get(out) == simdjson::SUCCESS;
}
bool read(const element& value, std::string_view& out) {
  return value.get(out) == simdjson::SUCCESS;
}

bool read(const element& value, std::string& out) {
  std::string_view text;
  if (!read(value, text)) return false;
  out = text;
  return true;
}

template <class T>
Result<std::vector<T>> read_array(const ParamValues& values, std::string_view name,
                                  const char* what) {
  std::vector<T> out;
  const element* value = find(values, name, ParamType::array);
  simdjson::dom::array array;
  if (value == nullptr || value->get(array) != simdjson::SUCCESS) return out;
  for (const element item : array) {
    if (!read(item, out.emplace_back()))
      return fail(ErrorCode::usage, "parameter " + in_quotes(name) + ": element " +
                                        std::to_string(out.size()) + " is not " + what);
  }
  return out;
}

template <class T>
T read_or(const ParamValues& values, std::string_view name, ParamType type, T fallback) {
  if (const element* value = find(values, name, type)) read(*value, fallback);
  return fallback;
}

}  // namespace

bool Params::has(std::string_view name) const {
  return find(values_, name, std::nullopt) != nullptr;
}

std::string_view Params::string(std::string_view name, std::string_view fallback) const {
  return read_or(values_, name, ParamType::string, fallback);
}

double Params::number(std::string_view name, double fallback) const {
  return read_or(values_, name, ParamType::number, fallback);
}

std::int64_t Params::integer(std::string_view name, std::int64_t fallback) const {
  return read_or(values_, name, ParamType::integer, fallback);
}

bool Params::boolean(std::string_view name, bool fallback) const {
  return read_or(values_, name, ParamType::boolean, fallback);
}

Result<std::vector<double>> Params::numbers(std::string_view name) const {
  return read_array<double>(values_, name, "a number");
}

Result<std::vector<std::int64_t>> Params::integers(std::string_view name) const {
  return read_array<std::int64_t>(values_, name, "an integer");
}

Result<std::vector<std::string>> Params::strings(std::string_view name) const {
  return read_array<std::string>(values_, name, "a string");
}

std::string Params::json(std::string_view name) const {
  const element* value = find(values_, name, std::nullopt);
  return value != nullptr ? simdjson::minify(*value) : std::string();
}

}  // namespace mdof::rpc
