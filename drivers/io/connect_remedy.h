// Why a device on a network cannot be reached, and what to do.
#pragma once

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// `error` of connect(2). `service`: this program was started by systemd, which may keep it from the
// network: packets are then refused, or dropped without a word.
Error connect_error(const Endpoint& to, int error, bool service);

}  // namespace mdof::drivers
