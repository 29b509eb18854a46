// The server side of Modbus TCP, as far as a T7 answers it: functions 03, 06 and 16. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/modbus/protocol.h"

namespace mdof::drivers::labjack_t7 {

struct ModbusRequest {
  modbus::Frame frame;
  std::uint8_t function = 0;
  int address = 0, count = 0;         // of registers
  std::vector<std::uint16_t> values;  // to be written
  bool well_formed = false;           // false: a count or length that cannot be
};

// Takes the first request off `bytes`; none: it is not complete yet. What is no Modbus TCP empties
// `bytes`.
std::optional<ModbusRequest> take_request(std::string& bytes);

std::string read_reply(const ModbusRequest& request, const std::vector<std::uint16_t>& values);
std::string write_reply(const ModbusRequest& request);  // of a well-formed one
std::string exception_reply(const ModbusRequest& request, int code);

}  // namespace mdof::drivers::labjack_t7
