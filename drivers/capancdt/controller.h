// What a controller is and how it is set up, through its command port.
#pragma once

#include <string>
#include <vector>

#include "drivers/capancdt/options.h"
#include "schema/result.h"

namespace mdof::drivers::capancdt {

// As the controller is after set-up.
struct Setup {
  std::string description;  // "DT6220, serial 1001, V1.2a"
  std::string serial;       // empty: not told
  int data_port = 0;
  double sample_time_us = 0;  // the actual one
  int averaged = 1;           // samples in a frame that is sent
  struct Input {
    double range_um = 0;
    bool maths = false;  // its values may lie outside the range
  };
  std::vector<Input> inputs;  // as Options::channels

  double frame_ns() const { return sample_time_us * 1e3 * averaged; }
};

// Connects, sets up, hangs up: the port is free for others then. Blocks,
// at most seconds. Errors name address and remedy.
Result<Setup> set_up_controller(const Options& options);

}  // namespace mdof::drivers::capancdt
