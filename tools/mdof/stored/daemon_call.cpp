#include "tools/mdof/stored/daemon_call.h"

#include "daemon/rpc/line/client.h"

namespace mdof::tools {

Result<std::string> call_daemon(const std::string& socket, std::string_view method,
                                std::string_view params) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(socket));
  return client.call(method, params);
}

}  // namespace mdof::tools
