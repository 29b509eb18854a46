// The devices of a configuration, for commands that open devices themselves. mdofd must not run at
// the same time.
#pragma once

#include <string>
#include <vector>

#include "daemon/measure/configuration/config.h"
#include "schema/base/result.h"

namespace CLI {
class App;
}

namespace mdof::tools {

struct DeviceChoice {
  std::string socket;  // Empty: the socket in the configuration.
  std::string config = "/etc/mdof/mdofd.toml";
  std::string name;  // Empty: all devices.
};

void add_device_choice(CLI::App& command, DeviceChoice& choice);

// Returns at least one device. Errors: no device has this name; mdofd runs and uses the devices
// (the message names `command`).
Result<std::vector<drivers::DriverSpec>> chosen_devices(const DeviceChoice& choice,
                                                        const std::string& command);

}  // namespace mdof::tools
