// mdof setup network: allows the packaged service to connect to a device on a network.
#include <CLI/CLI.hpp>

#include "schema/base/json_writer.h"
#include "tools/mdof/checks/network_access.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

struct SetupCommand {
  std::string address, units = "/etc/systemd/system";
  bool json = false;
};

constexpr const char* kNext = "sudo systemctl daemon-reload && sudo systemctl restart mdofd";

Status network(const SetupCommand& command) {
  MDOF_TRY(const std::string address, network_address(command.address));
  MDOF_TRY(const auto file, allow_address(command.units, address));
  if (!command.json)
    return write_line("wrote " + file.string() + ", which allows mdofd to connect to " + address +
                      ". To apply the change, run: " + kNext);
  JsonWriter json;
  json.begin_object()
      .field("file", file.string())
      .field("address", address)
      .field("next", kNext)
      .end_object();
  return write_line(json.take());
}

Action declare_setup_network(CLI::App& command) {
  const auto o = std::make_shared<SetupCommand>();
  command
      .add_option("ADDRESS", o->address,
                  "Address of the device, or of the network of the device, such as 192.168.0.0/24")
      ->required();
  command.add_option("--units", o->units, "Folder of the systemd units")
      ->capture_default_str()
      ->type_name("FOLDER");
  add_json_flag(command, o->json);
  return [o] { return network(*o); };
}

}  // namespace

Command setup_network_command() {
  return {.name = "setup network",
          .summary = "Allow mdofd to connect to a device on a network",
          .footer = "Example:\n  sudo mdof setup network 192.168.0.7",
          .declare = declare_setup_network};
}

}  // namespace mdof::tools
