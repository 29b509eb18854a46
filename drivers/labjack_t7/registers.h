// Reads and writes the registers of a T7 over Modbus TCP, 32 bits at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>

#include "drivers/io/byte_stream.h"
#include "drivers/labjack_t7/protocol.h"
#include "drivers/modbus/client.h"
#include "schema/base/result.h"

namespace mdof::drivers::labjack_t7 {

// Longest wait for a connection, for each port.
inline constexpr std::chrono::milliseconds kConnect{2000};

// Thread-bound. Errors name the register. If the device rejects a request, the error contains
// LabJack's text for the code in LAST_ERR_DETAIL. After an error the connection may be unusable.
class Registers {
 public:
  static Result<Registers> connect(const Endpoint& to);

  Result<std::uint32_t> u32(Register at);
  Result<float> f32(Register at);
  Status read(Register from, std::span<std::uint16_t> into);
  Status write(Register at, std::uint32_t value);
  Status write_f32(Register at, float value);
  Status write_u16(Register at, std::uint16_t value);
  // IPv4 address of the connected device; 0: the connection does not use IPv4.
  std::uint32_t peer_ipv4() const { return peer_ipv4_; }

 private:
  Registers(ModbusClient client, std::uint32_t peer_ipv4)
      : client_(std::move(client)), peer_ipv4_(peer_ipv4) {}
  Status put(Register at, std::span<const std::uint16_t> words);
  tl::unexpected<Error> explained(const char* what, Register at, Error error);

  ModbusClient client_;
  std::uint32_t peer_ipv4_;
};

}  // namespace mdof::drivers::labjack_t7
