// Error text and remedy for a network device that cannot be reached.
#pragma once

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// `address`: IP address of `to`, whose host may be a name. The rules of systemd and the remedy need
// this address. `error`: errno of connect(2). `service`: true if systemd has started this program.
// systemd may block the network access of a service; the kernel then rejects or drops its packets.
Error connect_error(const Endpoint& to, const std::string& address, int error, bool service);

}  // namespace mdof::drivers
