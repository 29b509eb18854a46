// A device that several axes share. One thread reads it for all of them. Each axis gets its
// channels with the names of its rig, as from its own device.
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

// Replaces `taken` by the channels of `block` that are in `part` (DriverSpec::part), with their
// names there.
void take_part(const SampleBlock& block, const drivers::ChannelPart& part, SampleBlock& taken);

// Parts are added and removed on the main thread.
class SharedDevice {
 public:
  explicit SharedDevice(const drivers::DriverSpec& spec);

 private:
  friend class DevicePart;
  // The part of one axis, as seen by the acquisition thread.
  struct AxisPart {
    drivers::DriverSpec spec;
    DeviceSink sink;
    SampleBlock block;  // memory for its part of the next block
    bool asked_to_stop = false;
    std::uint64_t dropped_scans = 0;      // reported with the next block
    std::uint64_t dropped = 0, lost = 0;  // blocks and scans, as in DeviceStatus
  };
  DeviceSink sink_for_all_axes();
  void distribute_block(const SampleBlock& block, std::uint64_t pass);
  void join(const std::shared_ptr<AxisPart>& axis_part);
  void leave(const std::shared_ptr<AxisPart>& axis_part);
  void request_stop(AxisPart& axis_part);
  DeviceStatus status_of(const AxisPart& axis_part) const;

  mutable std::mutex mutex_;
  std::vector<std::shared_ptr<AxisPart>>
      axis_parts_;           // protected by mutex_, including their content
  Acquisition acquisition_;  // destroyed first
};

// The devices that several axes share, by name. A device is created with its first part and
// destroyed with its last.
class SharedDevices {
 public:
  std::unique_ptr<DeviceReader> part(const drivers::DriverSpec& spec, DeviceSink sink);

 private:
  std::map<std::string, std::weak_ptr<SharedDevice>> devices_;
};

// The name of a device that gives both axes the same probes, so that only one of them can be
// measured at a time. "": none.
std::string shared_probes_device(const AxisConfig& a, const AxisConfig& b);

}  // namespace mdof::daemon
