// What a controller is and how it is set up, through its command port.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "drivers/capancdt/options.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::drivers::capancdt {

inline constexpr std::chrono::milliseconds kConnect{3000};  // to either port, at most

// As the controller is after set-up.
struct Setup {
  std::string description;  // "DT6220, serial 1001, V1.2a"
  std::string serial;       // empty: not known
  int data_port = 0;
  double sample_time_us = 0;  // the actual one
  int averaged = 1;           // samples in a frame that is sent
  int window = 1;             // samples that a value is made of
  struct Input {
    double range_um = 0;
    bool maths = false;     // its values may lie outside the range
    int linearisation = 0;  // $LIN
  };
  std::vector<Input> inputs;  // as Options::channels
  int low_pass = 0;           // $ALP, analogue
  Notices notices;            // of what it does to the values by itself

  double frame_ns() const { return sample_time_us * 1e3 * averaged; }
};

// Connects, sets up, hangs up: the port is free for others then. Blocks,
// at most seconds. Errors name address and remedy.
Result<Setup> set_up_controller(const Options& options);

}  // namespace mdof::drivers::capancdt
