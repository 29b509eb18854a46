// A driver that holds the lock of its device.
#pragma once

#include "drivers/driver_spec.h"

namespace mdof::drivers {

// Returns `spec` with drivers that take the device's lock at the first open() and keep it for life,
// even while the device is absent. open() fails while another program holds the lock.
DriverSpec locked(DriverSpec spec);

}  // namespace mdof::drivers
