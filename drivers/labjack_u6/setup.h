// Prepares a U6 for streaming, in the order of LabJack's exodriver.
#pragma once

#include <array>
#include <string>

#include "drivers/labjack_u6/protocol.h"
#include "drivers/usb/handle.h"

namespace mdof::drivers::labjack_u6 {

// Sends a command and returns the next reply of the device, without checking to which command it
// belongs.
Result<std::string> ask(usb::Handle& handle, const std::string& command);

// Discards earlier replies that were not read, then reads the identity.
Result<Identity> identify(usb::Handle& handle);
// Ends a running stream, also that of another program, and discards its remaining data.
Status stop_stream(usb::Handle& handle);
// Constants of the gains 0 ... 3.
Result<std::array<AinCalibration, 4>> read_ain_calibrations(usb::Handle& handle);
// Whether two timers still run on `fio` and the next line, as start_counter() sets them.
Result<bool> counter_runs(usb::Handle& handle, int fio);
// Starts the counter from 0.
Status start_counter(usb::Handle& handle, int fio);

}  // namespace mdof::drivers::labjack_u6
