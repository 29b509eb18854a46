// mdof device list|probe|monitor: what is there, what it says, at what rate and with what noise.
// `list` asks the daemon; `probe` and `monitor` open the devices of a configuration themselves, so
// the daemon must not hold them.
#include <CLI/CLI.hpp>
#include <cmath>

#include "daemon/measure/config.h"
#include "daemon/rpc/line/client.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/checks/device_probe.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/own_daemon.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/device_table.h"

namespace mdof::tools {
namespace {

struct DeviceCommand {
  std::string socket, own_socket, config, name;
  double for_s = 2;
  bool json = false;
};

Status list(const DeviceCommand& command) {
  MDOF_TRY(rpc::Client client, rpc::Client::connect(command.socket));
  MDOF_TRY(const std::string devices, client.call("device.list"));
  return command.json ? write_line(devices) : write_out(device_table(devices, terminal_columns()));
}

// Those to be opened here, by `verb`: not while mdofd has them.
Result<std::vector<drivers::DriverSpec>> devices_of(const DeviceCommand& command,
                                                    const std::string& verb) {
  MDOF_TRY(const daemon::Config config, daemon::load_config(command.config));
  MDOF_CHECK(refuse_beside_daemon("device " + verb, own_socket(config, command.own_socket)));
  std::vector<drivers::DriverSpec> chosen;
  std::string names;
  for (const auto& axis : config.axes) {
    for (const auto& device : axis.devices) {
      names += (names.empty() ? "" : ", ") + device.name;
      if (command.name.empty() || device.name == command.name) chosen.push_back(device);
    }
  }
  if (!chosen.empty()) return chosen;
  return fail(ErrorCode::not_found, command.config + ": no device is called \"" + command.name +
                                        "\"; there are " + (names.empty() ? "none" : names));
}

// Every device in turn; one that fails does not keep the others from being asked.
Status probe(const DeviceCommand& command) {
  MDOF_TRY(const auto devices, devices_of(command, "probe"));
  const Interrupt interrupt;
  Status worst;
  JsonWriter json;
  json.begin_object().key("devices").begin_array();
  for (const auto& device : devices) {
    const auto finding = probe_device(device, command.for_s, Interrupt::requested);
    json.raw(finding_json(finding));
    if (!command.json) MDOF_CHECK(write_out(finding_text(finding)));
    if (!finding.error.empty()) worst = io_error(finding.name + ": " + finding.error);
  }
  json.end_array().end_object();
  if (command.json) MDOF_CHECK(write_line(json.text()));
  return worst;
}

Status monitor(const DeviceCommand& command) {
  MDOF_TRY(const auto devices, devices_of(command, "monitor"));
  if (command.name.empty() && devices.size() > 1)
    return fail(ErrorCode::usage,
                "device monitor: which one? Give its name; mdof device probe asks all of them");
  const Interrupt interrupt;
  return monitor_device(devices.front(), Interrupt::requested);
}

CLI::App* on_config(CLI::App& group, const char* name, const char* what, DeviceCommand& o) {
  auto* command = group.add_subcommand(name, what);
  command->add_option("NAME", o.name, "Of the device [default: all]")->type_name("");
  command->add_option("--config", o.config, "Configuration of mdofd")
      ->capture_default_str()
      ->type_name("FILE");
  add_own_socket_option(*command, o.own_socket);
  return command;
}

}  // namespace

void add_device(CLI::App& app, Action& chosen) {
  const auto o = std::make_shared<DeviceCommand>();
  o->config = "/etc/mdof/mdofd.toml";
  auto* group = app.add_subcommand("device", "The devices: list, probe, monitor");
  group->require_subcommand(1);

  auto* listing = group->add_subcommand("list", "Devices of mdofd with state and counts");
  add_socket_option(*listing, o->socket);
  add_json_flag(*listing, o->json);
  listing->footer("Example:\n  mdof device list");
  listing->callback([o, &chosen] { chosen = [o] { return list(*o); }; });

  auto* probing = on_config(*group, "probe", "Open a device: identity, rate, noise, clock", *o);
  probing->add_option("--for-s", o->for_s, "Seconds to read")
      ->check(CLI::Range(0.1, 3600.0))
      ->capture_default_str();
  add_json_flag(*probing, o->json);
  probing->footer("Example:\n  mdof device probe --config mdofd.toml");
  probing->callback([o, &chosen] { chosen = [o] { return probe(*o); }; });

  auto* monitoring = on_config(*group, "monitor", "Print a device's values until Ctrl-C", *o);
  monitoring->footer("Example:\n  mdof device monitor --config mdofd.toml");
  monitoring->callback([o, &chosen] { chosen = [o] { return monitor(*o); }; });
  group->footer(
      "Examples:\n"
      "  mdof device list\n"
      "  mdof device probe capa-1 --config mdofd.toml\n"
      "probe and monitor open the device themselves: stop mdofd first.");
}

}  // namespace mdof::tools
