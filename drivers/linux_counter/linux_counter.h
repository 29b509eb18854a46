// Encoders at counters of the Linux counter subsystem, polled through sysfs.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/channels.h"
#include "drivers/sysfs/poller.h"

namespace mdof::drivers {

struct LinuxCounterOptions {
  std::string sysfs_root = "/sys";
  std::string device = "counter0";
  std::string chip;           // required contents of its file `name`; empty: any
  std::string function;       // required of each count; empty: any
  std::uint64_t ceiling = 0;  // used if the device has no such file
  double rate_hz = 500;
  std::vector<ChannelInput> channels;  // input "count0" ...
  SysfsRead read = sysfs_pread();      // reads the counts
};

// Values are in µm: counts · um_per_count.
std::unique_ptr<SysfsPoller> make_linux_counter(const std::string& name,
                                                const LinuxCounterOptions& options);

}  // namespace mdof::drivers
