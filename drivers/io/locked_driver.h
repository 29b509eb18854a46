// A driver whose device nobody else opens meanwhile.
#pragma once

#include "drivers/driver_spec.h"

namespace mdof::drivers {

// The same, with drivers that take the device's lock when they are first opened and keep it for
// their life, also while the device is away: it is theirs. open() fails while another has it.
DriverSpec locked(DriverSpec spec);

}  // namespace mdof::drivers
