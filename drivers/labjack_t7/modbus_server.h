// Server part of Modbus TCP, with the functions that a T7 supports: 03, 06 and 16. Pure.
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
  int address = 0, count = 0;         // address of the first register, number of registers
  std::vector<std::uint16_t> values;  // values to write
  bool well_formed = false;           // false: the number of registers or the length is impossible
};

// Removes the first request from `bytes`; nullopt: the request is not complete yet. Clears `bytes`
// if they do not have the format of Modbus TCP.
std::optional<ModbusRequest> take_request(std::string& bytes);

std::string read_reply(const ModbusRequest& request, const std::vector<std::uint16_t>& values);
std::string write_reply(const ModbusRequest& request);  // requires well_formed
std::string exception_reply(const ModbusRequest& request, int code);

}  // namespace mdof::drivers::labjack_t7
