#include "drivers/labjack_t7/modbus_server.h"

namespace mdof::drivers::labjack_t7 {
namespace {

using modbus::word_at;

constexpr std::size_t kHead = 6, kMostLength = 254;
constexpr std::size_t kFixed = 5;  // length of a request with a function and two words

std::string framed(const ModbusRequest& request, std::string pdu) {
  return modbus::wrap(modbus::Framing::tcp,
                      {request.frame.transaction, request.frame.unit, std::move(pdu)});
}

bool is_well_formed(const ModbusRequest& request) {
  const std::string& pdu = request.frame.pdu;
  const auto count = static_cast<std::size_t>(request.count);
  if (request.function != modbus::kWrite)
    return pdu.size() == kFixed && count >= 1 && count <= modbus::kMostRegisters;
  return count >= 1 && count <= modbus::kMostWritten && pdu.size() == kFixed + 1 + 2 * count &&
         static_cast<std::uint8_t>(pdu[kFixed]) == 2 * count;
}

void read_pdu(ModbusRequest& request) {
  const std::string& pdu = request.frame.pdu;
  request.function = static_cast<std::uint8_t>(pdu[0]);
  if (pdu.size() < kFixed) return;
  const bool one = request.function == modbus::kWriteOne;
  request.address = word_at(pdu, 1);
  request.count = one ? 1 : word_at(pdu, 3);
  request.well_formed = is_well_formed(request);
  for (std::size_t i = one ? 3 : kFixed + 1; i + 1 < pdu.size(); i += 2)
    request.values.push_back(word_at(pdu, i));
}

}  // namespace

std::optional<ModbusRequest> take_request(std::string& bytes) {
  if (bytes.size() < kHead) return std::nullopt;
  const std::size_t length = word_at(bytes, 4);
  if (word_at(bytes, 2) != 0 || length < 2 || length > kMostLength) {
    bytes.clear();
    return std::nullopt;
  }
  if (bytes.size() < kHead + length) return std::nullopt;
  ModbusRequest request;
  request.frame = {word_at(bytes, 0), static_cast<std::uint8_t>(bytes[kHead]),
                   bytes.substr(kHead + 1, length - 1)};
  bytes.erase(0, kHead + length);
  read_pdu(request);
  return request;
}

std::string read_reply(const ModbusRequest& request, const std::vector<std::uint16_t>& values) {
  std::string pdu{static_cast<char>(request.function), static_cast<char>(2 * values.size())};
  for (const std::uint16_t value : values) modbus::append_word(pdu, value);
  return framed(request, pdu);
}

// The reply repeats the request, but without the values of function 16.
std::string write_reply(const ModbusRequest& request) {
  return framed(request, request.frame.pdu.substr(0, kFixed));
}

std::string exception_reply(const ModbusRequest& request, int code) {
  return framed(request, {static_cast<char>(request.function | modbus::kExceptionBit),
                          static_cast<char>(code)});
}

}  // namespace mdof::drivers::labjack_t7
