// Reads the packets of port 702 and the scans in the packets.
#include "drivers/labjack_t7/protocol.h"
#include "drivers/modbus/protocol.h"

namespace mdof::drivers::labjack_t7 {
namespace {

using modbus::append_word;
using modbus::word_at;

constexpr std::size_t kHeader = 16;
// The length in a packet counts the bytes from the unit id on.
constexpr std::size_t kLengthFrom = 6;
constexpr std::uint8_t kFunction = 76, kType = 16;

std::uint8_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}
bool is_header(std::string_view b) {
  const std::size_t length = word_at(b, 4);
  return word_at(b, 2) == 0 && byte_at(b, 6) == kUnit && byte_at(b, 7) == kFunction &&
         byte_at(b, 8) == kType && length % 2 == 0 && length >= kHeader - kLengthFrom &&
         length <= kHeader - kLengthFrom + 2 * kMostSamples;
}

}  // namespace

std::string encode(const StreamPacket& packet) {
  std::string bytes;
  append_word(bytes, packet.transaction);
  append_word(bytes, 0);
  append_word(bytes, static_cast<unsigned>(kHeader - kLengthFrom + 2 * packet.samples.size()));
  bytes += {static_cast<char>(kUnit), static_cast<char>(kFunction), static_cast<char>(kType), 0};
  append_word(bytes, packet.backlog);
  append_word(bytes, packet.status);
  append_word(bytes, packet.info);
  for (const std::uint16_t sample : packet.samples) append_word(bytes, sample);
  return bytes;
}

void PacketReader::append(std::string_view bytes) {
  bytes_.erase(0, taken_);
  taken_ = 0;
  bytes_ += bytes;
}

Result<bool> PacketReader::next(StreamPacket& packet) {
  const std::string_view b = std::string_view(bytes_).substr(taken_);
  if (b.size() < kHeader) return false;
  if (!is_header(b))
    return io_error(
        "the data on the stream port are not stream packets of a T7; check the address of the "
        "T7");
  const std::size_t size = kLengthFrom + word_at(b, 4);
  if (b.size() < size) return false;
  packet.transaction = word_at(b, 0);
  packet.backlog = word_at(b, 10);
  packet.status = word_at(b, 12);
  packet.info = word_at(b, 14);
  packet.samples.clear();
  for (std::size_t i = kHeader; i < size; i += 2) packet.samples.push_back(word_at(b, i));
  taken_ += size;
  return true;
}

Status ScanNumbering::check(const StreamPacket& packet) const {
  if (packet.transaction != transaction_)
    return io_error("stream packet " + std::to_string(packet.transaction) +
                    " arrived instead of packet " + std::to_string(transaction_) +
                    ", so packets are missing");
  if (packet.status != 0 && packet.status != status::recovering &&
      packet.status != status::recovered)
    return io_error("the stream has stopped: " + error_text(packet.status));
  if (packet.samples.size() % words_ != 0)
    return io_error("a stream packet of " + std::to_string(packet.samples.size()) +
                    " samples does not contain whole scans of " + std::to_string(words_) +
                    " samples");
  return {};
}

Status ScanNumbering::take(const StreamPacket& packet, std::vector<Scan>& scans) {
  MDOF_CHECK(check(packet));
  ++transaction_;
  if (packet.status == status::recovered) return line_.take(packet.samples, packet.info, scans);
  return line_.take(packet.samples, std::nullopt, scans);
}

}  // namespace mdof::drivers::labjack_t7
