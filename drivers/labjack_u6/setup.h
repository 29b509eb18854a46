// Prepares a U6 for a stream, in the order of LabJack's exodriver.
#pragma once

#include <array>
#include <string>

#include "drivers/labjack_u6/protocol.h"
#include "drivers/usb/handle.h"

namespace mdof::drivers::labjack_u6 {

// Sends a command and returns the next reply of the device. Does not check that the reply belongs
// to this command.
Result<std::string> ask(usb::Handle& handle, const std::string& command);

// Discards unread replies to earlier commands, then reads the identity.
Result<Identity> identify(usb::Handle& handle);
// Ends a running stream, even if another program has started it, and discards its remaining data.
Status stop_stream(usb::Handle& handle);
// Returns the calibration constants for the gains 0 ... 3.
Result<std::array<AinCalibration, 4>> read_ain_calibrations(usb::Handle& handle);
// Whether the device still has two timers that begin at the line `fio`, as after start_counter().
Result<bool> counter_runs(usb::Handle& handle, int fio);
// Starts the counter from 0 on the line `fio` and the next line.
Status start_counter(usb::Handle& handle, int fio);

}  // namespace mdof::drivers::labjack_u6
