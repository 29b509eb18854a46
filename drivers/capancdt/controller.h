// Identifies a controller and sets it up through its command port.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "drivers/capancdt/options.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::drivers::capancdt {

inline constexpr std::chrono::milliseconds kConnect{3000};  // longest wait for each port

// State of the controller after set-up.
struct Setup {
  std::string description;  // "DT6220, serial 1001, V1.2a"
  std::string serial;       // empty: not known
  int data_port = 0;
  double sample_time_us = 0;  // actual value
  int averaged = 1;           // number of samples in a frame
  int window = 1;             // number of samples in a value
  struct Input {
    double range_um = 0;
    bool maths = false;     // maths function: values may be outside of the range
    int linearisation = 0;  // $LIN
  };
  std::vector<Input> inputs;  // in the order of Options::channels
  int low_pass = 0;           // $ALP, analogue
  Notices notices;            // corrections by the controller itself

  double frame_ns() const { return sample_time_us * 1e3 * averaged; }
};

// Connects, sets up and disconnects, so that other programs can use the port. Takes at most some
// seconds. Errors name address and remedy.
Result<Setup> set_up_controller(const Options& options);

}  // namespace mdof::drivers::capancdt
