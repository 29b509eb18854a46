// The devices of a configuration that a command opens itself, while no mdofd has them.
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
  std::string socket;  // empty: that of the configuration
  std::string config = "/etc/mdof/mdofd.toml";
  std::string name;  // empty: all of them
};

void add_device_choice(CLI::App& command, DeviceChoice& choice);

// Never empty. Error: none has that name; or mdofd runs and holds them, which `command` then says.
Result<std::vector<drivers::DriverSpec>> chosen_devices(const DeviceChoice& choice,
                                                        const std::string& command);

}  // namespace mdof::tools
