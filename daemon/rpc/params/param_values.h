// Checks the parameters of a call against the method's row. Private header.
#pragma once

#include <simdjson.h>

#include <optional>
#include <vector>

#include "daemon/rpc/method_table.h"

namespace mdof::rpc {

// `values` has one element for each parameter in the row of the method, in the same order. nullopt:
// the parameter is absent or null.
struct ParamValues {
  const Method* method = nullptr;
  std::vector<std::optional<simdjson::dom::element>> values;
};

// Fills `out` from the params of a request: an object (by name), an array (by position), or none.
// Error (usage): a parameter is missing, unknown or invalid; the message names it.
Status check_params(const Method& method, const std::optional<simdjson::dom::element>& params,
                    ParamValues& out);

}  // namespace mdof::rpc
