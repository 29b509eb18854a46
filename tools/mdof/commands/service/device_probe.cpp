// mdof device probe: opens a device and shows its description, rate and noise.
#include <CLI/CLI.hpp>

#include "schema/base/json_writer.h"
#include "schema/sample.h"
#include "tools/mdof/checks/device_probe.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/commands/service/opened_devices.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"

namespace mdof::tools {
namespace {

struct ProbeCommand {
  DeviceChoice choice;
  double for_s = 2;
  bool json = false;
};

// Error: more than half of the readings of a channel are not usable. Suspect readings are no error:
// an encoder has only such readings until its datum is set.
Status check_readings(const DeviceFinding& finding) {
  for (const ChannelFinding& c : finding.channels)
    if (2 * c.unusable > finding.scans && c.worst != to_string(Quality::suspect))
      return fail(ErrorCode::check, finding.name + ": channel \"" + c.id +
                                        "\": " + std::to_string(c.unusable) + " of " +
                                        std::to_string(finding.scans) +
                                        " readings are not usable; check probe, rig and input");
  return {};
}

// Probes all devices in turn; a failed device does not stop the others.
Status probe(const ProbeCommand& command) {
  MDOF_TRY(const auto devices, chosen_devices(command.choice, "device probe"));
  const Interrupt interrupt;
  Status worst;
  JsonWriter json;
  json.begin_object().key("devices").begin_array();
  for (const auto& device : devices) {
    const auto finding = probe_device(device, command.for_s, Interrupt::requested);
    json.raw(finding_json(finding));
    if (!command.json) MDOF_CHECK(write_out(finding_text(finding)));
    if (!finding.error.empty()) worst = io_error(finding.name + ": " + finding.error);
    if (worst) worst = check_readings(finding);
  }
  json.end_array().end_object();
  if (command.json) MDOF_CHECK(write_line(json.text()));
  return worst;
}

Action declare_probe(CLI::App& command) {
  const auto o = std::make_shared<ProbeCommand>();
  add_device_choice(command, o->choice);
  command.add_option("--for-s", o->for_s, "Number of seconds for which each device is read")
      ->check(number_in(0.1, 3600))
      ->capture_default_str();
  add_json_flag(command, o->json);
  return [o] { return probe(*o); };
}

}  // namespace

Command device_probe_command() {
  return {.name = "device probe",
          .summary = "Open the devices and show identity, rate, noise and clock of each device",
          .footer = "Example:\n  mdof device probe --config mdofd.toml",
          .declare = declare_probe};
}

}  // namespace mdof::tools
