// Requests to mdofd.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::tools {

// One request over a connection of its own; gives the result as JSON. A daemon that does not run
// is an io error that says how to start it.
Result<std::string> call_daemon(const std::string& socket, std::string_view method,
                                std::string_view params = "{}");

// The same, printed: as JSON, or readably.
Status print_call(const std::string& socket, std::string_view method, std::string_view params,
                  bool json);

}  // namespace mdof::tools
