// The devices that provide the channels of a rig.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/rig/rig.h"

namespace mdof::daemon {

struct ChannelSource {
  std::string device;
  std::vector<std::string> channels;  // empty: not known before the device is open
};

// Error: two devices provide the same channel of the rig.
Status check_no_channel_twice(const Rig& rig, const std::vector<ChannelSource>& devices);

// Error: no device provides a channel of the rig.
Status check_all_channels(const Rig& rig, const std::vector<ChannelSource>& devices);

}  // namespace mdof::daemon
