// A driver that locks its device.
#pragma once

#include "drivers/driver_spec.h"

namespace mdof::drivers {

// Changes make() of `spec`: its drivers lock the device at their first open() and unlock it in the
// destructor, even if the device was disconnected meanwhile. open() fails while another program has
// the lock.
DriverSpec locked(DriverSpec spec);

}  // namespace mdof::drivers
