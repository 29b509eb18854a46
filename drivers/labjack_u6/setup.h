// Makes a U6 ready to stream; the order is that of LabJack's exodriver.
#pragma once

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
Result<AinCalibration> read_ain_calibration(usb::Handle& handle, int gain);
// Whether two timers still run on FIO0 and FIO1, as start_counter() leaves them.
Result<bool> counter_runs(usb::Handle& handle);
// From 0.
Status start_counter(usb::Handle& handle);

}  // namespace mdof::drivers::labjack_u6
