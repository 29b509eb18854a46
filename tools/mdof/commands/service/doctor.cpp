// mdof doctor: checks this computer, the configuration and the devices, and prints remedies.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <set>

#include "daemon/measure/configuration/sources.h"
#include "daemon/rpc/line/client.h"
#include "daemon/words/error_text.h"
#include "drivers/registry.h"
#include "schema/base/json_writer.h"
#include "tools/mdof/checks/device_probe.h"
#include "tools/mdof/checks/doctor_checks.h"
#include "tools/mdof/checks/network_access.h"
#include "tools/mdof/commands/command.h"
#include "tools/mdof/interrupt.h"
#include "tools/mdof/options.h"
#include "tools/mdof/output.h"
#include "tools/mdof/stored/configured_daemon.h"
#include "tools/mdof/stored/json_read.h"
#include "tools/mdof/terminal.h"
#include "tools/mdof/text/text_table.h"

namespace mdof::tools {
namespace {

using Level = Diagnosis::Level;

constexpr double kProbe_s = 0.5;
constexpr std::size_t kRemedyIndent = 6;

struct DoctorCommand {
  std::string socket, config;
  bool json = false;
};

bool on_usb(const drivers::DriverSpec& device) {
  const drivers::DriverRow* row = drivers::find_driver(device.driver);
  return row && row->node && std::holds_alternative<drivers::UsbDevice>(*row->node);
}

Diagnosis diagnose(const drivers::DriverSpec& device, const DeviceFinding& found) {
  const std::string what = "device " + device.name + " (" + device.driver + ")";
  if (!found.error.empty()) return {Level::bad, what + ": " + found.error, ""};
  for (const auto& channel : found.channels) {
    // Some sources have suspect times when they are opened.
    if (channel.values == 0 ||
        (channel.unusable > 0 && channel.worst != to_string(Quality::suspect)))
      return {
          channel.values == 0 ? Level::bad : Level::doubtful,
          what + ": channel " + channel.id + ": " +
              (channel.values == 0 ? "no value is usable"
                                   : std::to_string(channel.unusable) + " of " +
                                         std::to_string(found.scans) + " values are not usable") +
              " (worst quality: " + channel.worst + ")",
          "check the sensor and its wiring; show the values of the device with: mdof device "
          "monitor " +
              device.name};
  }
  return {
      found.lost > 0 ? Level::doubtful : Level::good,
      what + ": " + std::to_string(found.scans) + " scans, " + std::to_string(found.lost) + " lost",
      found.lost > 0 ? "reduce the rate of the device, or the load of this computer" : ""};
}

// Whether the open devices of the axis provide each channel of its rig once. The columns of a
// script are known only when it runs. Devices that failed are reported on their own.
void add_sources(const daemon::AxisConfig& axis, const std::vector<DeviceFinding>& found,
                 std::vector<Diagnosis>& all) {
  std::vector<daemon::ChannelSource> sources;
  for (const DeviceFinding& device : found) {
    if (!device.error.empty()) return;
    sources.push_back({device.name, {}});
    for (const auto& channel : device.channels) sources.back().channels.push_back(channel.id);
  }
  for (const auto check : {daemon::check_no_channel_twice, daemon::check_all_channels})
    if (const Status checked = check(axis.rig, sources); !checked)
      all.push_back({Level::bad,
                     std::string("axis ") + letter(axis.rig.axis) + ": " + checked.error().message,
                     "correct the key \"channel\" of the devices, or the columns of the script"});
}

// The diagnosis of a device from the state that mdofd reports.
Diagnosis diagnosis_from(const simdjson::dom::element& device) {
  const std::string state = text(device, "state"), error = text(device, "error");
  std::string what =
      "device " + text(device, "device") + " (" + text(device, "driver") + "): " + state;
  if (!error.empty()) return {Level::bad, what + ": " + error, ""};
  what += ", " + std::to_string(integer(device, "scans").value_or(0)) + " scans, " +
          std::to_string(integer(device, "scans_lost").value_or(0)) + " lost";
  const std::string trouble = joined(texts(device, "trouble"), "; ");
  return {trouble.empty() ? Level::good : Level::bad, what, trouble};
}

// Asks a running mdofd for the states of its devices, because this program cannot open them at the
// same time.
std::vector<Diagnosis> query_device_list(const daemon::Config& config, const std::string& socket) {
  std::vector<Diagnosis> all = {
      {Level::good, "mdofd is running (" + socket + ") and uses the devices", ""}};
  auto client = rpc::Client::connect(socket);
  const auto list = client ? client->call("device.list") : tl::unexpected(client.error());
  simdjson::dom::parser parser;
  simdjson::dom::array devices;
  if (!list || parser.parse(simdjson::padded_string(*list))["devices"].get_array().get(devices)) {
    all.push_back({Level::bad, "mdofd does not report the state of its devices",
                   "to see the reason, run: mdof device list"});
    return all;
  }
  std::set<std::string> known;
  for (const auto device : devices) {
    known.insert(text(device, "device"));
    all.push_back(diagnosis_from(device));
  }
  for (const auto& axis : config.axes)
    for (const auto& device : axis.devices)
      if (!known.contains(device.name))
        all.push_back(
            {Level::doubtful, "device " + device.name + " is not a device of the running mdofd",
             "mdofd runs with another configuration; restart mdofd with this configuration"});
  return all;
}

std::vector<Diagnosis> try_devices(const daemon::Config& config, const std::string& socket) {
  std::error_code unknown;
  const auto path = std::filesystem::absolute(socket, unknown);
  std::vector<Diagnosis> all = {
      {Level::good, "no mdofd answers at " + path.string() + ", so mdof opens the devices", ""}};
  const Interrupt interrupt;
  for (const auto& axis : config.axes) {
    std::vector<DeviceFinding> found;
    for (const auto& device : axis.devices) {
      if (!device.live || device.is_declared_elsewhere) continue;
      found.push_back(probe_device(device, kProbe_s, Interrupt::requested));
      all.push_back(diagnose(device, found.back()));
    }
    if (found.size() == axis.devices.size()) add_sources(axis, found, all);
  }
  return all;
}

std::vector<Diagnosis> check_devices(const daemon::Config& config, const std::string& socket) {
  const auto runs = daemon_runs(socket);
  if (!runs)
    return {
        {Level::bad,
         "devices: not checked, because mdofd may have opened them: " + words::text(runs.error()),
         ""}};
  return *runs ? query_device_list(config, socket) : try_devices(config, socket);
}

std::vector<Diagnosis> examine(const DoctorCommand& command) {
  const Machine machine;
  std::vector<Diagnosis> all = {check_clock(machine)};
  const auto add = [&](std::vector<Diagnosis> more) {
    all.insert(all.end(), more.begin(), more.end());
  };
  const auto config = daemon::load_config(command.config);
  bool usb = false;
  if (config) {
    for (const auto& axis : config->axes)
      for (const auto& device : axis.devices) usb = usb || on_usb(device);
  }
  all.push_back(check_udev_rules(machine, usb));
  add(check_usb(machine));
  add(check_class_devices(machine));
  add(check_sysfs_files(machine, service_group()));
  if (!config) {
    all.push_back(
        {Level::bad, "configuration: " + words::text(config.error()),
         "to check the configuration, run: mdofd --check-config --config " + command.config});
    return all;
  }
  all.push_back({Level::good, "configuration: " + command.config, ""});
  all.push_back(check_storage(*config));
  for (const auto& axis : config->axes) all.push_back(check_set_up(axis.rig));
  add(check_network(machine, *config));
  add(check_devices(*config, configured_socket(*config, command.socket)));
  return all;
}

Status print(const std::vector<Diagnosis>& all, bool as_json) {
  JsonWriter json;
  std::string text;
  const std::size_t columns = terminal_columns();
  json.begin_object().key("findings").begin_array();
  for (const auto& d : all) {
    json.begin_object()
        .field("level", to_string(d.level))
        .field("what", d.what)
        .field("remedy", d.remedy)
        .end_object();
    text += wrapped(std::string(to_string(d.level)) + "  " + d.what, columns, kRemedyIndent) + "\n";
    if (!d.remedy.empty())
      text += fitted(std::string(kRemedyIndent, ' ') + d.remedy, columns, 0) + "\n";
  }
  json.end_array().end_object();
  return as_json ? write_line(json.text()) : write_out(text);
}

Status doctor(const DoctorCommand& command) {
  const auto all = examine(command);
  MDOF_CHECK(print(all, command.json));
  const auto bad = std::count_if(all.begin(), all.end(),
                                 [](const Diagnosis& d) { return d.level == Level::bad; });
  if (bad == 0) return {};
  return fail(ErrorCode::check,
              std::to_string(bad) + (bad == 1 ? " problem" : " problems") + " found");
}

Action declare_doctor(CLI::App& command) {
  const auto o = std::make_shared<DoctorCommand>();
  o->config = "/etc/mdof/mdofd.toml";
  command.add_option("--config", o->config, "Configuration of mdofd")
      ->capture_default_str()
      ->type_name("FILE");
  add_configured_socket_option(command, o->socket);
  add_json_flag(command, o->json);
  return [o] { return doctor(*o); };
}

}  // namespace

Command doctor_command() {
  return {.name = "doctor",
          .summary = "Check this computer, the configuration and the devices; print remedies",
          .footer = "Example:\n  mdof doctor --config mdofd.toml",
          .declare = declare_doctor};
}

}  // namespace mdof::tools
