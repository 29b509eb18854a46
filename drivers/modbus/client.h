// Modbus TCP and RTU by libmodbus, with what a daemon needs around it.
//
// libmodbus takes a late RTU reply for the answer to the next request, lets a dripping peer hold a
// call, and aborts on a descriptor above 1,023. Here no value is given out that was not asked for:
// after any error of RTU the line is kept silent, drained, and proved with a request of another
// length before values count again; after any error of TCP but an exception, which is an answer,
// the connection is of no more use. The response time-out bounds the whole frame, recovery inside
// the library is off, descriptors that select() cannot take are refused.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "drivers/io/byte_stream.h"
#include "schema/base/result.h"

namespace mdof::drivers {

// Thread-bound; at most one request under way.
class ModbusClient {
 public:
  struct Options {
    int unit = 1;  // TCP: 255 or the unit behind a gateway; RTU: 1 ... 247
    std::chrono::milliseconds response_timeout{200};
    std::chrono::milliseconds gap{2};  // RTU: silence before a request, 3.5 characters or more
  };
  // Takes the connection over. Errors: a descriptor of 1,024 or more.
  static Result<ModbusClient> over_tcp(ByteStream connection, const Options& options);
  static Result<ModbusClient> over_rtu(ByteStream line, const Options& options);
  ~ModbusClient();
  ModbusClient(ModbusClient&&) noexcept;
  ModbusClient& operator=(ModbusClient&&) noexcept;

  // `into` is filled from `address` on, at most 125 registers. Errors name the device, the register
  // and what happened: silence, an exception by its name, a reply that is none. Each takes at most
  // the response time-out; a client that is not trusted two and a half of them.
  Status read_holding(int address, std::span<std::uint16_t> into);   // function 03
  Status read_input(int address, std::span<std::uint16_t> into);     // function 04
  Status write(int address, std::span<const std::uint16_t> values);  // function 16

  // False after an error: a TCP client is to be made anew; an RTU client, which also starts so,
  // proves its line with the next calls. After an exception a TCP client is still trusted.
  bool trusted() const;
  // Errors since the start that values were kept from: late, cut, foreign replies and so on.
  std::uint64_t rejected() const;
  // The exception, 1 ... 255, that the last request was answered with; 0: it was not.
  int exception() const;

 private:
  Status read(int function, int address, std::span<std::uint16_t> into);
  struct Impl;
  explicit ModbusClient(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::drivers
