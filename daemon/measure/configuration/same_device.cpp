#include "daemon/measure/configuration/same_device.h"

#include <algorithm>

namespace mdof::daemon {
namespace {

// The ids of the channels in the table.
std::vector<std::string> given(TomlTable& device) {
  std::vector<std::string> ids;
  for (TomlTable& channel : device.tables("channel")) ids.push_back(channel.string("id"));
  return ids;
}

bool has(const std::vector<std::string>& ids, const std::string& id) {
  return std::find(ids.begin(), ids.end(), id) != ids.end();
}

struct Source {
  const AxisConfig* axis = nullptr;
  const drivers::DriverSpec* device = nullptr;
};

Result<Source> source_of(TomlTable& table, const std::vector<AxisConfig>& above) {
  const std::string name = table.string("same_as");
  std::string known;
  for (const AxisConfig& axis : above) {
    for (const auto& device : axis.devices) {
      if (device.is_declared_elsewhere) continue;
      if (device.name == name) return Source{&axis, &device};
      known += (known.empty() ? "" : ", ") + device.name;
    }
  }
  return bad_input(table.where("same_as") +
                   ": no earlier [[axis]] of this file has a device named \"" + name +
                   "\"; devices of earlier axes: " + (known.empty() ? "none" : known));
}

// Error: two axes cannot share this device. Two axes can share only hardware whose channels are
// known before the device is opened.
Status check_source(const TomlTable& table, const drivers::DriverSpec& device) {
  if (device.live && device.recorded && !device.simulated && !device.part.empty()) return {};
  return bad_input(table.where("same_as") + ": \"" + device.name + "\" (" + device.driver +
                   ") cannot serve two axes: only a hardware device with [[axis.device.channel]] "
                   "entries can serve two axes; give this axis its own device");
}

}  // namespace

bool is_same_as(TomlTable& device) {
  return device.has("same_as");
}

std::vector<drivers::FurtherAxis> further_axes(const std::string& name,
                                               std::vector<AxisTables>& later) {
  std::vector<drivers::FurtherAxis> further;
  for (AxisTables& axis : later)
    for (TomlTable& device : axis.devices)
      if (is_same_as(device) && device.string("same_as") == name)
        further.push_back({axis.rig, device});
  return further;
}

Status restrict_to_first_axis(drivers::DriverSpec& device,
                              std::vector<drivers::FurtherAxis>& further) {
  if (further.empty()) return {};
  std::vector<std::string> others;
  for (auto& axis : further) {
    for (const std::string& id : given(axis.table)) {
      others.push_back(drivers::further_id(id, axis.rig.axis));
      if (has(device.channels, others.back())) continue;
      return bad_input(axis.table.where("channel") + ": a device with driver " + device.driver +
                       " can share only its probes with a second axis; provide channel \"" + id +
                       "\" with another device ([[axis.device]])");
    }
  }
  std::erase_if(device.channels, [&](const std::string& id) { return has(others, id); });
  for (const std::string& id : device.channels) device.part[id] = id;
  return {};
}

Result<drivers::DriverSpec> read_same_as(TomlTable& table, const std::vector<AxisConfig>& above,
                                         double settle_s, AxisConfig& axis) {
  MDOF_TRY(const Source source, source_of(table, above));
  MDOF_CHECK(check_source(table, *source.device));
  drivers::DriverSpec device = *source.device;
  device.is_declared_elsewhere = true;
  device.part.clear();
  device.channels = given(table);
  for (const std::string& id : device.channels)
    device.part[drivers::further_id(id, axis.rig.axis)] = id;
  read_delays(table, axis.rig, settle_s, axis.delays);
  for (const Probe& probe : axis.rig.probes) {
    if (!source.device->part.contains(probe.id) || has(device.channels, probe.id)) continue;
    device.part[probe.id] = probe.id;
    device.channels.push_back(probe.id);
    const auto delay = source.axis->delays.find(probe.id);
    if (delay != source.axis->delays.end()) axis.delays[probe.id] = delay->second;
  }
  if (device.channels.empty())
    return bad_input(table.where("same_as") + ": \"" + device.name + "\" provides no probe of " +
                     axis.rig.source +
                     ", and this entry lists no channel; correct same_as or add channels");
  const auto encoder =
      device.further_encoders.find(drivers::further_id(kEncoderChannel, axis.rig.axis));
  device.encoder =
      encoder == device.further_encoders.end() ? drivers::EncoderOrigin{} : encoder->second;
  return device;
}

}  // namespace mdof::daemon
