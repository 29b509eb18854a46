#include "tools/mdof/stored/daemon_call.h"

#include "daemon/rpc/line/client.h"
#include "tools/mdof/output.h"
#include "tools/mdof/text/json_text.h"

namespace mdof::tools {

Result<std::string> call_daemon(const std::string& socket, std::string_view method,
                                std::string_view params) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(socket));
  return client.call(method, params);
}

Status print_call(const std::string& socket, std::string_view method, std::string_view params,
                  bool json) {
  auto result = call_daemon(socket, method, params);
  if (!result) return in_context("mdofd", result.error());
  return json ? write_line(*result) : write_out(readable(*result));
}

}  // namespace mdof::tools
