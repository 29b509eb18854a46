// The parameters of one call, already checked against the method's row.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "daemon/rpc/caller.h"
#include "schema/base/result.h"

namespace mdof::rpc {

struct ParamValues;  // see param_values.h

// Use only names of the row, with the type of the row; anything else is a programming error. An
// optional parameter that is absent or null gives the fallback. Thread-bound, and valid only until
// the handler returns: keep copies, not views.
class Params {
 public:
  Params(const ParamValues& values, Caller& caller) : values_(values), caller_(caller) {}

  bool has(std::string_view name) const;
  std::string_view string(std::string_view name, std::string_view fallback = {}) const;
  double number(std::string_view name, double fallback = 0) const;
  std::int64_t integer(std::string_view name, std::int64_t fallback = 0) const;
  bool boolean(std::string_view name, bool fallback = false) const;
  // The elements of an array. An element of another type gives a usage error that names it. Empty
  // if absent.
  Result<std::vector<double>> numbers(std::string_view name) const;
  Result<std::vector<std::int64_t>> integers(std::string_view name) const;
  Result<std::vector<std::string>> strings(std::string_view name) const;
  // Any value as JSON text without spaces. Empty if absent.
  std::string json(std::string_view name) const;

  Caller& caller() const { return caller_; }

 private:
  const ParamValues& values_;
  Caller& caller_;
};

}  // namespace mdof::rpc
