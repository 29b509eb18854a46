// How a capaNCDT controller is attached.
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
inline constexpr int kDataPort = 10001;  // as delivered

// $AVT of the manual.
enum class Averaging { none = 0, moving = 1, arithmetic = 2, median = 3, dynamic = 4 };
const char* to_string(Averaging averaging);  // as in the configuration
// Of a reading: it holds nothing older. Error: longer than `settle_s`, if that is known.
Status check_filter(double sample_time_us, int averaged_values, double settle_s);

struct Options {
  std::string name;  // of the device
  Endpoint command;
  std::optional<int> data_port;  // none: the controller is asked
  std::string serial;            // empty: any controller at this address
  bool configure = true;         // settings may be changed; else they must be as given
  std::optional<int> sample_time_us;
  std::optional<Averaging> averaging;
  std::optional<int> averaged_values;  // 2 ... 8
  std::int32_t guard_counts = 16;      // so near an end of 0 ... 0xFFFFFF is over range
  struct Channel {
    ChannelInput input;
    int number = 0;             // 1 ... 32
    double range_um = 0;        // 0: the controller says
    bool rig_corrects = false;  // the rig has a linearity or polynomial for it
  };
  std::vector<Channel> channels;
  double settle_s = 0;  // no filter may last longer; 0: not known
  // These are not in the configuration; tests shorten them.
  std::chrono::milliseconds reply_timeout{1000};
  // The first packet may have been held up on its way, and the clock of the device moves only
  // slowly once a sample has been given out with its time: no sample is given out before this has
  // passed.
  std::chrono::milliseconds warm_up{100};
  std::chrono::milliseconds silence{2000};  // of the data port that is an error
};

}  // namespace mdof::drivers::capancdt
