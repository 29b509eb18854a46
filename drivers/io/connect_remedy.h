// What to do where a device on a network cannot be reached.
#pragma once

#include <string>

#include "drivers/io/byte_stream.h"

namespace mdof::drivers {

// `error` of connect(2). `service`: this program was started by systemd, which may keep it from the
// network: packets are then refused, or dropped without a word.
std::string connect_remedy(const Endpoint& to, int error, bool service);

}  // namespace mdof::drivers
