// Conversion between Modbus messages and bytes: application data units of TCP and RTU, requests and
// answers. Pure; accepts any bytes. Source: MODBUS Application Protocol Specification V1.1b3,
// MODBUS over Serial Line V1.02.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "schema/base/result.h"

namespace mdof::drivers::modbus {

enum class Framing { tcp, rtu };

enum Function : std::uint8_t { kReadHolding = 3, kReadInput = 4, kWriteOne = 6, kWrite = 16 };
inline constexpr std::uint8_t kExceptionBit = 0x80;
inline constexpr int kLastAddress = 65535;
inline constexpr int kMostRegisters = 125;  // in one read request
inline constexpr int kMostWritten = 123;    // in one write request

// Contents of an application data unit. An RTU unit has no transaction number.
struct Frame {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 1;
  std::string pdu;  // function code and data
};

std::uint16_t crc16(std::string_view bytes);  // its low byte is sent first
std::uint16_t word_at(std::string_view bytes, std::size_t offset);
void append_word(std::string& bytes, unsigned word);

std::string wrap(Framing framing, const Frame& frame);
// `adu`: one complete application data unit. Errors: it is too short; its protocol, length or CRC
// is wrong.
Result<Frame> unwrap(Framing framing, std::string_view adu);

std::string read_request(Function function, int address, int count);
std::string write_request(int address, std::span<const std::uint16_t> values);

// The answer to a request: the registers that were read, or an exception (1 ... 255).
struct Answer {
  int exception = 0;
  std::string registers;  // two bytes for each register
};
// Error: `adu` is not an answer to `asked`. Its transaction, unit, function, length or echoed data
// differ.
Result<Answer> answer_to(const Frame& asked, Framing framing, std::string_view adu);

const char* exception_name(int code);  // "illegal data address"

}  // namespace mdof::drivers::modbus
