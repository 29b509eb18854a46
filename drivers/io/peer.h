// The peer of a connection.
#pragma once

#include <cstdint>

#include "drivers/io/byte_stream.h"

namespace mdof::drivers {

// IPv4 address of the peer; 192.168.0.5 is 0xC0A80005. 0: the connection does not use IPv4.
std::uint32_t peer_ipv4(const ByteStream& connection);

}  // namespace mdof::drivers
