// Makes a U6 ready to stream; the order is that of LabJack's exodriver.
#pragma once

#include <array>
#include <string>

#include "drivers/labjack_u6/protocol.h"
#include "drivers/usb/handle.h"

namespace mdof::drivers::labjack_u6 {

// Sends a command; the reply, of whatever is the device's next.
Result<std::string> ask(usb::Handle& handle, const std::string& command);

// Throws away replies that nobody fetched before.
Result<Identity> identify(usb::Handle& handle);
// Ends a stream that runs, of whoever's, and throws away what is left of it.
Status stop_stream(usb::Handle& handle);
// Of the gains 0 ... 3.
Result<std::array<AinCalibration, 4>> read_ain_calibrations(usb::Handle& handle);
// Whether two timers still run on `fio` and the line after it, as start_counter() leaves them.
Result<bool> counter_runs(usb::Handle& handle, int fio);
// From 0.
Status start_counter(usb::Handle& handle, int fio);

}  // namespace mdof::drivers::labjack_u6
