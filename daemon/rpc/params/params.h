// The parameters of one call. The server has already checked them against the row of the method.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/caller.h"
#include "schema/base/result.h"

namespace mdof::rpc {

struct ParamValues;  // see param_values.h

// Use only names in the row of the method, with the type in this row; another name or type is a
// programming error. If an optional parameter is absent or null, the functions return `fallback`.
// Thread-bound. Valid only until the handler returns: keep copies, not views.
class Params {
 public:
  Params(const ParamValues& values, Caller& caller) : values_(values), caller_(caller) {}

  bool has(std::string_view name) const;
  std::string_view string(std::string_view name, std::string_view fallback = {}) const;
  double number(std::string_view name, double fallback = 0) const;
  std::int64_t integer(std::string_view name, std::int64_t fallback = 0) const;
  bool boolean(std::string_view name, bool fallback = false) const;
  // The elements of an array; empty if the parameter is absent. Error (usage): an element has
  // another type; the message names the element.
  Result<std::vector<double>> numbers(std::string_view name) const;
  Result<std::vector<std::int64_t>> integers(std::string_view name) const;
  Result<std::vector<std::string>> strings(std::string_view name) const;
  // Any value as JSON text without spaces. Empty if the parameter is absent.
  std::string json(std::string_view name) const;

  Caller& caller() const { return caller_; }

 private:
  const ParamValues& values_;
  Caller& caller_;
};

}  // namespace mdof::rpc
