// mdof device list: lists the devices of mdofd.
#include <CLI/CLI.hpp>

#include "daemon/rpc/line/client.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/device_table.h"

namespace mdof::tools {
namespace {

struct ListDevicesCommand {
  std::string socket;
  bool json = false;
};

Status list(const ListDevicesCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  MDOF_TRY(const std::string devices, client.call("device.list"));
  return command.json ? write_line(devices) : write_out(device_table(devices, terminal_columns()));
}

Action declare_list(CLI::App& command) {
  const auto o = std::make_shared<ListDevicesCommand>();
  add_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return list(*o); };
}

}  // namespace

Command device_list_command() {
  return {.name = "device list",
          .summary = "List the devices of mdofd with state, rate, scans and lost scans",
          .footer = "Example:\n  mdof device list",
          .declare = declare_list};
}

}  // namespace mdof::tools
