// Client for Modbus TCP and RTU. It uses libmodbus and adds the protection that a daemon needs.
//
// libmodbus has three weaknesses: it takes a late RTU reply as the answer to the next request; a
// peer that sends bytes slowly blocks a call; it aborts if a file descriptor is above 1,023. This
// class returns only values that were requested. After any error on RTU it sends nothing for some
// time, discards received bytes, and tests the line with a request of another length before it
// accepts values again. After an error on TCP the connection is unusable; a Modbus exception is an
// answer and not such an error. The response time-out limits the whole frame, the automatic
// recovery of libmodbus is off, and descriptors that select() cannot use are rejected.
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

// Thread-bound. At most one request is pending.
class ModbusClient {
 public:
  struct Options {
    int unit = 1;  // TCP: 255, or the number of the unit behind a gateway; RTU: 1 ... 247
    std::chrono::milliseconds response_timeout{200};
    // RTU: silence before a request; it must be at least 3.5 characters long.
    std::chrono::milliseconds gap{2};
  };
  // Takes ownership of the connection. Error: the number of the descriptor is 1,024 or more.
  static Result<ModbusClient> over_tcp(ByteStream connection, const Options& options);
  static Result<ModbusClient> over_rtu(ByteStream line, const Options& options);
  ~ModbusClient();
  ModbusClient(ModbusClient&&) noexcept;
  ModbusClient& operator=(ModbusClient&&) noexcept;

  // Reads at most 125 or writes at most 123 registers, from `address` on. Errors name the device,
  // the register and the cause: no reply, the name of a Modbus exception, or an invalid reply. A
  // call takes at most the response time-out, or 2.5 times the response time-out if trusted() is
  // false.
  Status read_holding(int address, std::span<std::uint16_t> into);   // function 03
  Status read_input(int address, std::span<std::uint16_t> into);     // function 04
  Status write(int address, std::span<const std::uint16_t> values);  // function 16

  // False after an error, except a Modbus exception on TCP. A TCP client must then be created
  // again. An RTU client tests its line in the next calls. Before the first test, trusted() of an
  // RTU client is false.
  bool trusted() const;
  // Number of errors since the start. They include missing, late, truncated or unrelated replies,
  // and exceptions.
  std::uint64_t rejected() const;
  // Middle of the interval from the last request to its reply. A test of the line before the
  // request is not in this interval.
  std::chrono::steady_clock::time_point answered_at() const;
  // Exception code 1 ... 255 in the answer to the last request; 0: no exception.
  int exception() const;

 private:
  Status read(int function, int address, std::span<std::uint16_t> into);
  struct Impl;
  explicit ModbusClient(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace mdof::drivers
