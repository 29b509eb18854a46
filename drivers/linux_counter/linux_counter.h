// Driver for encoders at counters of the Linux counter subsystem. It reads the counts repeatedly
// through sysfs.
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
  std::string chip;           // required contents of the device's file `name`; empty: any
  std::string function;       // required function of each count; empty: any
  std::uint64_t ceiling = 0;  // used if the device has no file `ceiling`
  double rate_hz = 500;
  std::vector<ChannelInput> channels;  // the inputs have the names "count0" ...
  SysfsRead read = sysfs_pread();      // reads the counts
};

// The values are in µm: count · um_per_count.
std::unique_ptr<SysfsPoller> make_linux_counter(const std::string& name,
                                                const LinuxCounterOptions& options);

}  // namespace mdof::drivers
