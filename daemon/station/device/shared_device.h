// A device that several axes share. One thread reads the device. Each axis receives only its own
// channels, with the channel ids of its rig.
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

// Copies the channels of `block` that `part` contains (DriverSpec::part) to `taken`, with the ids
// that `part` states. The old content of `taken` is lost.
void take_part(const SampleBlock& block, const drivers::ChannelPart& part, SampleBlock& taken);

// Parts are added and removed on the main thread.
class SharedDevice {
 public:
  explicit SharedDevice(const drivers::DriverSpec& spec);

 private:
  friend class DevicePart;
  // The channels and the receiver of one axis.
  struct AxisPart {
    drivers::DriverSpec spec;
    DeviceSink sink;
    SampleBlock block;  // memory for the channels of the axis in the next block
    bool asked_to_stop = false;
    std::uint64_t dropped_scans = 0;  // number of dropped scans; the next block reports this number
    std::uint64_t dropped = 0, lost = 0;  // number of blocks, number of scans; as in DeviceStatus
  };
  DeviceSink sink_for_all_axes();
  void distribute_block(const SampleBlock& block, std::uint64_t pass);
  void join(const std::shared_ptr<AxisPart>& axis_part);
  void leave(const std::shared_ptr<AxisPart>& axis_part);
  void request_stop(AxisPart& axis_part);
  DeviceStatus status_of(const AxisPart& axis_part) const;

  mutable std::mutex mutex_;
  // mutex_ protects the list and the objects in it.
  std::vector<std::shared_ptr<AxisPart>> axis_parts_;
  Acquisition acquisition_;  // destroyed first
};

// The devices that several axes share, by name. A device is created for the first axis that uses
// it, and destroyed after the last axis.
class SharedDevices {
 public:
  std::unique_ptr<DeviceReader> part(const drivers::DriverSpec& spec, DeviceSink sink);

 private:
  std::map<std::string, std::weak_ptr<SharedDevice>> devices_;
};

// The name of a device whose channels both axes use. Only one of these axes can be measured at a
// time. "": the axes share no channel.
std::string shared_probes_device(const AxisConfig& a, const AxisConfig& b);

}  // namespace mdof::daemon
