// Capacitance probes at an AD7745/AD7746 converter of Linux industrial I/O, through sysfs.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/channels.h"
#include "drivers/linux_iio/protocol.h"
#include "drivers/sysfs/poller.h"

namespace mdof::drivers {

struct LinuxIioOptions {
  std::string sysfs_root = "/sys";
  std::string device = "iio:device0";
  double rate_hz = 5;
  std::int64_t sampling_hz = 0;        // sampling rate to set in the converter; 0: unchanged
  std::vector<ChannelInput> channels;  // input "capacitance0", "capacitance0-capacitance2" ...
  std::vector<GapLaw> laws;            // [channel]
  SysfsRead read = sysfs_pread();      // reads the raw values
};
const std::vector<std::string>& ad7746_inputs();
const std::vector<std::int64_t>& ad7746_sampling_hz();

// Values are gaps in µm. Each reading triggers a conversion; channels are read one after the other.
std::unique_ptr<SysfsPoller> make_linux_iio(const std::string& name,
                                            const LinuxIioOptions& options);

}  // namespace mdof::drivers
