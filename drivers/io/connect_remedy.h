// Error text and remedy for a network device that cannot be reached.
#pragma once

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// `error`: errno of connect(2). `service`: systemd started this program and may block its network
// access: packets are then refused or dropped silently.
Error connect_error(const Endpoint& to, int error, bool service);

}  // namespace mdof::drivers
