// A driver that locks its device.
#pragma once

#include "drivers/driver_spec.h"

namespace mdof::drivers {

// Returns `spec` with another make(). The drivers that it makes lock the device at their first
// open(). They unlock it in the destructor, not when the device is disconnected. open() fails while
// another program has the lock.
DriverSpec locked(DriverSpec spec);

}  // namespace mdof::drivers
