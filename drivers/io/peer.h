// Who is at the other end of a connection.
#pragma once

#include <cstdint>

#include "drivers/io/byte_stream.h"

namespace mdof::drivers {

// The address of the other side, 192.168.0.5 as 0xC0A80005; 0: not by IPv4.
std::uint32_t peer_ipv4(const ByteStream& connection);

}  // namespace mdof::drivers
