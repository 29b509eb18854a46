// The server side of Modbus TCP, as far as a T7 answers it: functions 03, 06 and 16. Pure.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace mdof::drivers::labjack_t7 {

struct ModbusRequest {
  std::uint16_t transaction = 0;
  std::uint8_t unit = 0, function = 0;
  int address = 0, count = 0;         // of registers
  std::vector<std::uint16_t> values;  // to be written
  bool well_formed = false;           // else: answered with exception 3, function unknown with 1
};

// Takes the first request off `bytes`; none: it is not complete yet. What is no Modbus TCP empties
// `bytes`.
std::optional<ModbusRequest> take_request(std::string& bytes);

std::string read_reply(const ModbusRequest& request, const std::vector<std::uint16_t>& values);
std::string write_reply(const ModbusRequest& request);
std::string exception_reply(const ModbusRequest& request, int code);

}  // namespace mdof::drivers::labjack_t7
