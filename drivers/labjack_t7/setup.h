// Prepares a T7 for a stream. Each function writes a few registers, in the order of the T-Series
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
// Errors: the words of 32-bit values are swapped; the device is not a T7; its serial number differs
// from `settings`; its firmware is too old for a stream; the connection uses WiFi.
Result<Identity> identify(Registers& registers, const Settings& settings);

// Ends a running stream, even if another program has started it.
Status stop_stream(Registers& registers);

// Sets the range and the negative input of each analogue input. Returns one set of calibration
// constants for each input.
Result<std::vector<AinCalibration>> set_up_ains(Registers& registers, const Settings& settings);

// Starts the counter on the line `dio` and the next line. Returns true if the counter was already
// running and keeps its count; false if it was started from 0.
Result<bool> start_counter(Registers& registers, int dio);

// Writes all stream registers except STREAM_ENABLE. Returns the actual scan rate in Hz.
Result<double> set_up_stream(Registers& registers, const Settings& settings);

}  // namespace mdof::drivers::labjack_t7
