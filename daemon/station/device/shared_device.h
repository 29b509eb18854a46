// A device that several axes have: read once, by one thread, for all of them. Each is given the
// channels that are for it, under the names of its rig, as if it had a device of its own.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "daemon/measure/configuration/config.h"
#include "daemon/station/device/acquisition.h"
#include "daemon/station/device/device_reader.h"

namespace mdof::daemon {

// Replaces `taken` by the channels of `block` that `part` (DriverSpec::part) is of, under their
// names there.
void take_part(const SampleBlock& block, const drivers::ChannelPart& part, SampleBlock& taken);

// Parts come and go on the main thread.
class SharedDevice {
 public:
  explicit SharedDevice(const drivers::DriverSpec& spec);

 private:
  friend class DevicePart;
  // Of one axis, as the acquiring thread sees it.
  struct Taker {
    drivers::DriverSpec spec;
    DeviceSink sink;
    SampleBlock block;  // for its part of the next
    bool ceased = false;
    std::uint64_t dropped_scans = 0;      // to be reported with the next block
    std::uint64_t dropped = 0, lost = 0;  // blocks and scans, as of DeviceStatus
  };
  DeviceSink fan_out();
  void hand_out(const SampleBlock& block, std::uint64_t pass);
  void join(const std::shared_ptr<Taker>& taker);
  void leave(const std::shared_ptr<Taker>& taker);
  void cease(Taker& taker);
  DeviceStatus status_of(const Taker& taker) const;

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<Taker>> takers_;  // guarded by mutex_, and what they hold
  Acquisition acquisition_;                     // goes first
};

// Those of several axes, by name: each is made with its first part and lives as long as one.
class SharedDevices {
 public:
  std::unique_ptr<DeviceReader> part(const drivers::DriverSpec& spec, DeviceSink sink);

 private:
  std::map<std::string, std::weak_ptr<SharedDevice>> devices_;
};

// The name of a device that gives both axes the same probes: only one of them can be measured at a
// time. "": there is none.
std::string same_probes(const AxisConfig& a, const AxisConfig& b);

}  // namespace mdof::daemon
