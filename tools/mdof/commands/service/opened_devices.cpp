#include "tools/mdof/commands/service/opened_devices.h"

#include <CLI/CLI.hpp>

#include "tools/mdof/stored/configured_daemon.h"

namespace mdof::tools {

void add_device_choice(CLI::App& command, DeviceChoice& choice) {
  command.add_option("NAME", choice.name, "Name of the device [default: all devices]")
      ->type_name("");
  command.add_option("--config", choice.config, "Configuration of mdofd")
      ->capture_default_str()
      ->type_name("FILE");
  add_configured_socket_option(command, choice.socket);
}

Result<std::vector<drivers::DriverSpec>> chosen_devices(const DeviceChoice& choice,
                                                        const std::string& command) {
  MDOF_TRY(const daemon::Config config, daemon::load_config(choice.config));
  MDOF_CHECK(check_daemon_stopped(command, configured_socket(config, choice.socket)));
  std::vector<drivers::DriverSpec> chosen;
  std::string names;
  for (const auto& axis : config.axes) {
    for (const auto& device : axis.devices) {
      if (device.is_declared_elsewhere) continue;
      names += (names.empty() ? "" : ", ") + device.name;
      if (choice.name.empty() || device.name == choice.name) chosen.push_back(device);
    }
  }
  if (!chosen.empty()) return chosen;
  return fail(ErrorCode::not_found,
              choice.config + ": no device is named \"" + choice.name +
                  "\"; configured devices: " + (names.empty() ? "none" : names));
}

}  // namespace mdof::tools
