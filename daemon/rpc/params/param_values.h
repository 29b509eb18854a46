// Checks the parameters of a call against the method's row. Private header.
#pragma once

#include <simdjson.h>

#include <optional>
#include <vector>

#include "daemon/rpc/method_table.h"

namespace mdof::rpc {

// One value for each parameter of the row, in its order; empty: absent or null.
struct ParamValues {
  const Method* method = nullptr;
  std::vector<std::optional<simdjson::dom::element>> values;
};

// Fills `out` from the request's params (object: by name; array: by position; or none). Errors are
// `usage` and name the parameter.
Status check_params(const Method& method, const std::optional<simdjson::dom::element>& params,
                    ParamValues& out);

}  // namespace mdof::rpc
