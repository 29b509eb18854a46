// Makes a T7 ready to stream. Each step is a few registers; the order is that of the T-Series
// Datasheet 3.2.4.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/labjack_t7/registers.h"
#include "drivers/labjack_t7/settings.h"

namespace mdof::drivers::labjack_t7 {

struct Identity {
  std::uint32_t serial = 0;
  float firmware = 0;
};
// Errors: words swapped on the way, no T7, another serial number than `settings` asks for, firmware
// too old to stream as is needed, connected by WiFi.
Result<Identity> identify(Registers& registers, const Settings& settings);

// Ends a stream that runs, of whoever's.
Status stop_stream(Registers& registers);

// Range and negative channel of each input; gives the constants of each, in their order.
Result<std::vector<AinCalibration>> set_up_ains(Registers& registers, const Settings& settings);

// Lets the counter of `dio` and the line after it run. True: it was running and its count goes on;
// false: it was started, from 0.
Result<bool> start_counter(Registers& registers, int dio);

// All but STREAM_ENABLE. Gives the true rate in Hz.
Result<double> set_up_stream(Registers& registers, const Settings& settings);

}  // namespace mdof::drivers::labjack_t7
