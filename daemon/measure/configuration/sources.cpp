#include "daemon/measure/configuration/sources.h"

#include <algorithm>

#include "schema/sample.h"

namespace mdof::daemon {
namespace {

std::vector<std::string> channels_of(const Rig& rig) {
  std::vector<std::string> all = {kEncoderChannel};
  for (const Probe& probe : rig.probes) all.push_back(probe.id);
  return all;
}

bool provides(const ChannelSource& device, const std::string& channel) {
  return std::find(device.channels.begin(), device.channels.end(), channel) !=
         device.channels.end();
}

}  // namespace

Status check_no_channel_twice(const Rig& rig, const std::vector<ChannelSource>& devices) {
  for (const std::string& channel : channels_of(rig)) {
    const ChannelSource* first = nullptr;
    for (const ChannelSource& device : devices) {
      if (!provides(device, channel)) continue;
      if (first)
        return bad_input("channel \"" + channel + "\" comes from two devices, \"" + first->device +
                         "\" and \"" + device.device +
                         "\"; remove the channel from one of the two");
      first = &device;
    }
  }
  return {};
}

Status check_all_channels(const Rig& rig, const std::vector<ChannelSource>& devices) {
  for (const std::string& channel : channels_of(rig))
    if (std::none_of(devices.begin(), devices.end(),
                     [&](const ChannelSource& device) { return provides(device, channel); }))
      return bad_input("no device provides channel \"" + channel + "\" of " + rig.source +
                       "; add this channel to a device");
  return {};
}

}  // namespace mdof::daemon
