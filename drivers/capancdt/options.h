// Options of a capaNCDT controller.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/channels.h"
#include "drivers/io/byte_stream.h"

namespace mdof::drivers::capancdt {

inline constexpr int kCommandPort = 23;
inline constexpr int kDataPort = 10001;  // data port that the controller uses by default

// Averaging types: parameter of $AVT in the manual.
enum class Averaging { none = 0, moving = 1, arithmetic = 2, median = 3, dynamic = 4 };
const char* to_string(Averaging averaging);  // name in the configuration
// Error: the samples in the filter span more than `settle_s`, so that a reading at a target would
// contain samples from before the axis stopped. `settle_s` 0: no check.
Status check_filter(double sample_time_us, int averaged_values, double settle_s);

struct Options {
  std::string name;  // name of the device
  Endpoint command;
  std::optional<int> data_port;  // nullopt: ask the controller
  std::string serial;            // empty: any controller at this address
  // True: the driver may change settings; false: settings must already agree.
  bool configure = true;
  std::optional<int> sample_time_us;
  std::optional<Averaging> averaging;
  std::optional<int> averaged_values;  // 2 ... 8
  std::int32_t guard_counts = 16;  // a reading at most this far from 0 or 0xFFFFFF is over range
  struct Channel {
    ChannelInput input;
    int number = 0;       // 1 ... 32
    double range_um = 0;  // 0: use the range that the controller states
    // True: the rig has a linearity table or a polynomial for this channel.
    bool rig_corrects = false;
  };
  std::vector<Channel> channels;
  double settle_s = 0;  // longest permitted duration of the filter; 0: not known
  // The following options are not in the configuration; tests shorten them.
  std::chrono::milliseconds reply_timeout{1000};
  // The driver returns no sample before this time has elapsed. The first packet may be late, and
  // after the first returned sample the device clock corrects the resulting offset only slowly.
  std::chrono::milliseconds warm_up{100};
  std::chrono::milliseconds silence{2000};  // longest silence of the data port
};

}  // namespace mdof::drivers::capancdt
