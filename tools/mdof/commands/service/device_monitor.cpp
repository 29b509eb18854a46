// mdof device monitor: opens a device and prints its values.
#include <CLI/CLI.hpp>

#include "tools/mdof/checks/device_probe.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/service/opened_devices.h"
#include "tools/mdof/interrupt.h"

namespace mdof::tools {
namespace {

Status monitor(const DeviceChoice& choice) {
  MDOF_TRY(const auto devices, chosen_devices(choice, "device monitor"));
  if (choice.name.empty() && devices.size() > 1)
    return fail(ErrorCode::usage,
                "device monitor: the configuration has several devices; give the NAME of one "
                "device (to read all devices, use: mdof device probe)");
  const Interrupt interrupt;
  return monitor_device(devices.front(), Interrupt::requested);
}

Action declare_monitor(CLI::App& command) {
  const auto choice = std::make_shared<DeviceChoice>();
  add_device_choice(command, *choice);
  return [choice] { return monitor(*choice); };
}

}  // namespace

Command device_monitor_command() {
  return {.name = "device monitor",
          .summary = "Print a device's values until Ctrl-C",
          .footer = "Example:\n  mdof device monitor --config mdofd.toml",
          .declare = declare_monitor};
}

}  // namespace mdof::tools
