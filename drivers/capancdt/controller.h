// Identifies a controller and sets it up through its command port.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "drivers/capancdt/options.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::drivers::capancdt {

// Longest wait for a connection, for each port.
inline constexpr std::chrono::milliseconds kConnect{3000};

// State of the controller after set_up_controller().
struct Setup {
  std::string description;  // "DT6220, serial 1001, V1.2a"
  std::string serial;       // empty: not known
  int data_port = 0;
  double sample_time_us = 0;  // actual value
  int averaged = 1;           // number of samples in the mean that a frame contains
  int window = 1;             // number of samples that contribute to a value
  struct Input {
    double range_um = 0;
    bool maths = false;     // true: a maths function; its values may be outside of the range
    int linearisation = 0;  // setting of $LIN
  };
  std::vector<Input> inputs;  // in the order of Options::channels
  int low_pass = 0;           // setting of $ALP: analogue low-pass filter
  Notices notices;            // corrections that the controller itself applies

  double frame_ns() const { return sample_time_us * 1e3 * averaged; }
};

// Connects to the command port, sets up the controller and disconnects, so that other programs can
// use the port. Takes at most some seconds. Errors name the address and the remedy.
Result<Setup> set_up_controller(const Options& options);

}  // namespace mdof::drivers::capancdt
