// Driver for capacitance probes at an AD7745 or AD7746 converter of the Linux IIO subsystem,
// through sysfs.
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
  // Sampling rate that the driver sets in the converter; 0: the driver does not change it.
  std::int64_t sampling_hz = 0;
  // The inputs have the names "capacitance0", "capacitance0-capacitance2" ...
  std::vector<ChannelInput> channels;
  std::vector<GapLaw> laws;        // one for each channel
  SysfsRead read = sysfs_pread();  // reads the raw values
};
const std::vector<std::string>& ad7746_inputs();
const std::vector<std::int64_t>& ad7746_sampling_hz();

// The values are gaps in µm. Each reading starts a conversion; the channels are read one after the
// other.
std::unique_ptr<SysfsPoller> make_linux_iio(const std::string& name,
                                            const LinuxIioOptions& options);

}  // namespace mdof::drivers
