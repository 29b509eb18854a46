#include "tools/mdof/stored/configured_daemon.h"

#include <CLI/CLI.hpp>
#include <cerrno>

#include "daemon/rpc/line/client.h"
#include "daemon/rpc/net/socket.h"

namespace mdof::tools {

void add_configured_socket_option(CLI::App& command, std::string& socket) {
  command.add_option("--socket", socket, "Socket of mdofd [default: as in the configuration]")
      ->type_name("PATH");
}

const std::string& configured_socket(const daemon::Config& config, const std::string& given) {
  return given.empty() ? config.socket : given;
}

Result<bool> daemon_runs(const std::string& socket) {
  MDOF_CHECK(rpc::check_unix_path(socket));
  const auto answer = rpc::connect_to_unix(socket);
  if (answer) return true;
  if (answer.error() == ENOENT || answer.error() == ECONNREFUSED) return false;
  // Returns the error with its reason.
  MDOF_TRY(const rpc::Client client, rpc::Client::connect(socket));
  return true;
}

Status check_daemon_stopped(const std::string& command, const std::string& socket) {
  const auto runs = daemon_runs(socket);
  if (!runs)
    return in_context(command + ": cannot find out whether mdofd uses the devices", runs.error());
  if (!*runs) return {};
  return io_error(command + ": mdofd runs (" + socket +
                  ") and uses the devices, but this command must open the devices; stop mdofd "
                  "first, or use \"mdof device list\" or \"mdof live\"");
}

}  // namespace mdof::tools
