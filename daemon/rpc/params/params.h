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

// Names are those of the row; to ask for another name, or for another type than the row states, is
// a bug. What is optional and absent (or null) gives the fallback.
// Thread-bound, and valid only until the handler returns: keep copies, not views.
class Params {
 public:
  Params(const ParamValues& values, Caller& caller) : values_(values), caller_(caller) {}

  bool has(std::string_view name) const;
  std::string_view string(std::string_view name, std::string_view fallback = {}) const;
  double number(std::string_view name, double fallback = 0) const;
  std::int64_t integer(std::string_view name, std::int64_t fallback = 0) const;
  bool boolean(std::string_view name, bool fallback = false) const;
  // Of an array; an element of another type is a usage error that names it. Absent: empty.
  Result<std::vector<double>> numbers(std::string_view name) const;
  Result<std::vector<std::int64_t>> integers(std::string_view name) const;
  Result<std::vector<std::string>> strings(std::string_view name) const;
  // Any value as JSON text without spaces. Absent: empty.
  std::string json(std::string_view name) const;

  Caller& caller() const { return caller_; }

 private:
  const ParamValues& values_;
  Caller& caller_;
};

}  // namespace mdof::rpc
