// Sends requests to mdofd.
#pragma once

#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::tools {

// Sends one request over a separate connection and returns the result as JSON. Error (io): mdofd
// does not run; the message says how to start it.
Result<std::string> call_daemon(const std::string& socket, std::string_view method,
                                std::string_view params = "{}");

}  // namespace mdof::tools
