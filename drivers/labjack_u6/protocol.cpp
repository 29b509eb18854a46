// Frames and the stream's packets; the commands are in commands.cpp.
#include "drivers/labjack_u6/protocol.h"

#include <algorithm>

namespace mdof::drivers::labjack_u6 {
namespace {

constexpr std::uint8_t kExtended = 0xF8, kData = 0xF9, kStreamData = 0xC0;
constexpr std::size_t kHead = 6, kNormalReply = 4;

std::uint16_t word_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint16_t>(byte_at(bytes, i) | byte_at(bytes, i + 1) << 8);
}
void append_word(std::string& bytes, unsigned word) {
  bytes += static_cast<char>(word & 0xFF);
  bytes += static_cast<char>(word >> 8 & 0xFF);
}

unsigned sum(std::string_view bytes) {
  unsigned total = 0;
  for (const char c : bytes) total += static_cast<std::uint8_t>(c);
  return total;
}

// Adds the header of six bytes before `body`.
std::string framed(std::uint8_t kind, std::size_t size, std::uint8_t command,
                   std::string_view body) {
  std::string rest{static_cast<char>(kind), static_cast<char>(size), static_cast<char>(command)};
  append_word(rest, checksum16(body));
  return static_cast<char>(checksum8(rest)) + rest + std::string(body);
}

Status check_frame(std::string_view bytes) {
  if (bytes.size() >= 2 && byte_at(bytes, 0) == 0xB8 && byte_at(bytes, 1) == 0xB8)
    return io_error(
        "the U6 received data with a wrong checksum (its reply is B8 B8); check the cable");
  if (bytes.size() < kHead) return io_error("a reply of the U6 is incomplete; check the cable");
  if (byte_at(bytes, 0) != checksum8(bytes.substr(1, kHead - 1)) ||
      word_at(bytes, 4) != checksum16(bytes.substr(kHead)))
    return io_error("a checksum in the data of the U6 is wrong; check the cable");
  return {};
}

Status check_order(std::uint8_t counter, std::uint8_t expected) {
  if (counter == expected) return {};
  return io_error("stream packet " + std::to_string(counter) + " arrived instead of packet " +
                  std::to_string(expected) + ", so packets are missing");
}

}  // namespace

// Adds all bytes. Then, two times, adds the quotient of the sum and 256 to the remainder.
std::uint8_t checksum8(std::string_view bytes) {
  const unsigned total = sum(bytes);
  const unsigned once = total / 256 + total % 256;
  return static_cast<std::uint8_t>(once / 256 + once % 256);
}

std::uint16_t checksum16(std::string_view bytes) {
  return static_cast<std::uint16_t>(sum(bytes));
}

std::string extended(std::uint8_t command, std::string_view body) {
  return framed(kExtended, body.size() / 2, command, body);
}

std::string normal(std::uint8_t command) {
  return std::string(2, static_cast<char>(command));  // the command consists only of its checksum
}

Result<std::string> extended_body(std::string_view reply, std::uint8_t command, std::size_t size) {
  MDOF_CHECK(check_frame(reply));
  if (byte_at(reply, 1) != kExtended || byte_at(reply, 3) != command || reply.size() != size ||
      byte_at(reply, 2) != (size - kHead) / 2)
    return io_error(
        "the reply of the U6 belongs to another command; unplug the U6 and plug it in again");
  return std::string(reply.substr(kHead));
}

Result<int> normal_error(std::string_view reply, std::uint8_t command) {
  if (reply.size() < kNormalReply) {
    MDOF_CHECK(check_frame(reply));
    return io_error("a reply of the U6 is incomplete; check the cable");
  }
  if (byte_at(reply, 0) != checksum8(reply.substr(1)))
    return io_error("a checksum in the data of the U6 is wrong; check the cable");
  if (byte_at(reply, 1) != command + 1 || reply.size() != kNormalReply)
    return io_error(
        "the reply of the U6 belongs to another command; unplug the U6 and plug it in again");
  return static_cast<int>(byte_at(reply, 2));
}

std::string encode(const StreamData& packet) {
  std::string body;
  append_word(body, packet.dropped);
  append_word(body, 0);
  body += static_cast<char>(packet.counter);
  body += static_cast<char>(packet.error);
  for (const std::uint16_t sample : packet.samples) append_word(body, sample);
  body += static_cast<char>(packet.backlog);
  body += '\0';
  return framed(kData, 4 + packet.samples.size(), kStreamData, body);
}

Result<StreamData> decode(std::string_view bytes, std::size_t samples) {
  MDOF_CHECK(check_frame(bytes));
  if (bytes.size() != stream_bytes(samples) || byte_at(bytes, 1) != kData ||
      byte_at(bytes, 2) != 4 + samples || byte_at(bytes, 3) != kStreamData)
    return io_error("the stream data of the U6 are not a packet of " + std::to_string(samples) +
                    " samples");
  StreamData packet;
  packet.counter = byte_at(bytes, 10);
  packet.error = byte_at(bytes, 11);
  packet.dropped = packet.error == kRecovered ? word_at(bytes, 6) : std::uint16_t{0};
  for (std::size_t i = 0; i < samples; ++i) packet.samples.push_back(word_at(bytes, 12 + 2 * i));
  packet.backlog = byte_at(bytes, 12 + 2 * samples);
  return packet;
}

Status ScanNumbering::take(const StreamData& packet, std::vector<Scan>& scans) {
  MDOF_CHECK(check_order(packet.counter, counter_));
  ++counter_;
  if (packet.error == kRecovered) return line_.take(packet.samples, packet.dropped, scans);
  if (packet.error != 0 && packet.error != kRecovering)
    return io_error("the stream has stopped: " + error_text(packet.error));
  return line_.take(packet.samples, std::nullopt, scans);
}

}  // namespace mdof::drivers::labjack_u6
