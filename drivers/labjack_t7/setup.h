// Prepares a T7 for streaming. Each step writes a few registers, in the order of the T-Series
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
// Errors: swapped words, not a T7, a serial number that differs from `settings`, firmware that is
// too old for streaming, a connection by WiFi.
Result<Identity> identify(Registers& registers, const Settings& settings);

// Ends a running stream, also that of another program.
Status stop_stream(Registers& registers);

// Sets range and negative channel of each input. Returns one set of constants for each input.
Result<std::vector<AinCalibration>> set_up_ains(Registers& registers, const Settings& settings);

// Starts the counter of `dio` and the next line. Returns true if the counter was running and keeps
// its count; false if it was started from 0.
Result<bool> start_counter(Registers& registers, int dio);

// Writes all stream registers except STREAM_ENABLE. Returns the true rate in Hz.
Result<double> set_up_stream(Registers& registers, const Settings& settings);

}  // namespace mdof::drivers::labjack_t7
