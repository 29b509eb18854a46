#include "drivers/labjack_t7/modbus_server.h"

#include <string_view>

namespace mdof::drivers::labjack_t7 {
namespace {

constexpr std::size_t kHead = 6, kMostLength = 254;
constexpr std::uint8_t kRead = 3, kWriteOne = 6, kWrite = 16;

std::uint8_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}
std::uint16_t word_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint16_t>(byte_at(bytes, i) << 8 | byte_at(bytes, i + 1));
}
void put(std::string& bytes, std::size_t word) {
  bytes += static_cast<char>(word >> 8 & 0xFF);
  bytes += static_cast<char>(word & 0xFF);
}

// `body`: from the function on.
std::string framed(const ModbusRequest& request, const std::string& body) {
  std::string bytes;
  put(bytes, request.transaction);
  put(bytes, 0);
  put(bytes, body.size() + 1);
  return bytes + static_cast<char>(request.unit) + body;
}

void read_body(ModbusRequest& request, std::string_view body) {
  request.function = byte_at(body, 0);
  if (body.size() < 5) return;
  request.address = word_at(body, 1);
  request.count = request.function == kWriteOne ? 1 : word_at(body, 3);
  std::size_t from = body.size();
  if (request.function == kWriteOne) from = 3;
  if (request.function == kWrite) from = 6;
  for (std::size_t i = from; i + 1 < body.size(); i += 2)
    request.values.push_back(word_at(body, i));
  const auto count = static_cast<std::size_t>(request.count);
  if (request.function == kRead)
    request.well_formed = body.size() == 5 && count >= 1 && count <= 125;
  if (request.function == kWriteOne) request.well_formed = body.size() == 5;
  if (request.function == kWrite)
    request.well_formed =
        count >= 1 && count <= 123 && body.size() == 6 + 2 * count && byte_at(body, 5) == 2 * count;
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
  request.transaction = word_at(bytes, 0);
  request.unit = byte_at(bytes, kHead);
  read_body(request, std::string_view(bytes).substr(kHead + 1, length - 1));
  bytes.erase(0, kHead + length);
  return request;
}

std::string read_reply(const ModbusRequest& request, const std::vector<std::uint16_t>& values) {
  std::string body{static_cast<char>(request.function), static_cast<char>(2 * values.size())};
  for (const std::uint16_t value : values) put(body, value);
  return framed(request, body);
}

std::string write_reply(const ModbusRequest& request) {
  std::string body{static_cast<char>(request.function)};
  put(body, static_cast<std::size_t>(request.address));
  put(body,
      request.function == kWriteOne ? request.values[0] : static_cast<std::size_t>(request.count));
  return framed(request, body);
}

std::string exception_reply(const ModbusRequest& request, int code) {
  return framed(request, {static_cast<char>(request.function | 0x80), static_cast<char>(code)});
}

}  // namespace mdof::drivers::labjack_t7
