// Server side of Modbus TCP, limited to what a T7 supports: functions 03, 06 and 16. Pure.
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
  bool well_formed = false;           // false: impossible count or length
};

// Removes the first request from `bytes`; nullopt: it is not complete yet. Clears `bytes` if they
// are not Modbus TCP.
std::optional<ModbusRequest> take_request(std::string& bytes);

std::string read_reply(const ModbusRequest& request, const std::vector<std::uint16_t>& values);
std::string write_reply(const ModbusRequest& request);  // request must be well-formed
std::string exception_reply(const ModbusRequest& request, int code);

}  // namespace mdof::drivers::labjack_t7
