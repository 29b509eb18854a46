// Modbus TCP and RTU through libmodbus, with the protection that a daemon needs.
//
// libmodbus treats a late RTU reply as the answer to the next request, lets a peer that sends bytes
// slowly block a call, and aborts on a descriptor above 1,023. This class returns only values that
// were requested. After any error on RTU it keeps the line silent, discards received bytes and
// tests the line with a request of another length before it uses values again. After an error on
// TCP the connection is unusable, except after an exception, which is an answer. The response
// time-out limits the whole frame, the recovery of the library is off, and descriptors that
// select() cannot use are refused.
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

// Thread-bound; at most one pending request.
class ModbusClient {
 public:
  struct Options {
    int unit = 1;  // TCP: 255, or the unit behind a gateway; RTU: 1 ... 247
    std::chrono::milliseconds response_timeout{200};
    std::chrono::milliseconds gap{2};  // RTU: silence before a request, at least 3.5 characters
  };
  // Takes ownership of the connection. Error: a descriptor of 1,024 or more.
  static Result<ModbusClient> over_tcp(ByteStream connection, const Options& options);
  static Result<ModbusClient> over_rtu(ByteStream line, const Options& options);
  ~ModbusClient();
  ModbusClient(ModbusClient&&) noexcept;
  ModbusClient& operator=(ModbusClient&&) noexcept;

  // Fills `into` with the registers from `address` on, at most 125. Errors name the device, the
  // register and the cause: no reply, the name of an exception, an invalid reply. A call takes at
  // most the response time-out; with a client that is not trusted, two and a half time-outs.
  Status read_holding(int address, std::span<std::uint16_t> into);   // function 03
  Status read_input(int address, std::span<std::uint16_t> into);     // function 04
  Status write(int address, std::span<const std::uint16_t> values);  // function 16

  // False after an error. A TCP client must then be created again; an RTU client, which also starts
  // untrusted, tests its line with the next calls. After an exception a TCP client is still
  // trusted.
  bool trusted() const;
  // Number of errors since the start: missing, late, truncated or foreign replies, exceptions.
  std::uint64_t rejected() const;
  // Exception 1 ... 255 in the answer to the last request; 0: none.
  int exception() const;

 private:
  Status read(int function, int address, std::span<std::uint16_t> into);
  struct Impl;
  explicit ModbusClient(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::drivers
