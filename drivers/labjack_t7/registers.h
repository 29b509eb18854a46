// The registers of a T7 over Modbus TCP, 32 bits at a time, with LabJack's own words for what it
// refuses.
#pragma once

#include <cstdint>
#include <span>

#include "drivers/io/byte_stream.h"
#include "drivers/labjack_t7/protocol.h"
#include "drivers/modbus/client.h"
#include "schema/result.h"

namespace mdof::drivers::labjack_t7 {

// Thread-bound. Errors name the register; a refusal carries the text of LAST_ERR_DETAIL. After one
// the connection may be of no more use.
class Registers {
 public:
  static Result<Registers> connect(const Endpoint& to);

  Result<std::uint32_t> u32(Register at);
  Result<float> f32(Register at);
  Status read(Register from, std::span<std::uint16_t> into);
  Status write(Register at, std::uint32_t value);
  Status write_f32(Register at, float value);
  Status write_u16(Register at, std::uint16_t value);

 private:
  Registers(Endpoint to, ModbusClient client) : to_(std::move(to)), client_(std::move(client)) {}
  Status put(Register at, std::span<const std::uint16_t> words);
  tl::unexpected<Error> explained(const char* what, Register at, Error error);

  Endpoint to_;
  ModbusClient client_;
};

}  // namespace mdof::drivers::labjack_t7
