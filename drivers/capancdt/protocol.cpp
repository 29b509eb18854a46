#include "drivers/capancdt/protocol.h"

#include <bit>
#include <cassert>

namespace mdof::drivers::capancdt {
namespace {

constexpr std::string_view kPreamble = "SAEM";  // "MEAS" as a number, little-endian
constexpr std::uint64_t kLowBits = 0x5555555555555555;
// Number of processed bytes that are kept in memory before they are erased.
constexpr std::size_t kKeep = 1 << 16;

template <class T>
T get(std::string_view bytes, std::size_t at) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i)
    value |= std::uint64_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
  return static_cast<T>(value);
}

template <class T>
void put(std::string& bytes, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i)
    bytes += static_cast<char>(static_cast<std::uint64_t>(value) >> (8 * i) & 0xFF);
}

// Returns a bit mask with the low bit of each pair whose value is 01.
std::uint64_t available(std::uint64_t channel_bits) {
  return channel_bits & ~(channel_bits >> 1) & kLowBits;
}

struct Sizes {
  std::size_t frames, bytes_per_frame;
};
std::optional<Sizes> sizes_of(std::string_view header) {
  const std::size_t a = get<std::uint16_t>(header, 24), b = get<std::uint16_t>(header, 26);
  const std::size_t channels =
      static_cast<std::size_t>(std::popcount(available(get<std::uint64_t>(header, 12))));
  if (channels == 0) return std::nullopt;
  const std::size_t bytes = 4 * channels;
  if (a != bytes && b != bytes) return std::nullopt;
  const Sizes sizes{a == bytes ? b : a, bytes};
  if (sizes.frames < 1 || sizes.frames > kMostFrames) return std::nullopt;
  return sizes;
}

}  // namespace

std::uint64_t channel_bit(int number) {
  assert(number >= 1 && number <= kMostChannels);
  return std::uint64_t{1} << (2 * (number - 1));
}

int Packet::channels() const {
  return std::popcount(available(channel_bits));
}

int Packet::frames() const {
  return channels() == 0 ? 0 : static_cast<int>(values.size()) / channels();
}

std::optional<int> Packet::position(int number) const {
  const std::uint64_t bit = channel_bit(number), bits = available(channel_bits);
  if (!(bits & bit)) return std::nullopt;
  return std::popcount(bits & (bit - 1));
}

std::string encode(const Packet& packet, SizeOrder order) {
  const auto frames = static_cast<std::uint16_t>(packet.frames());
  const auto bytes_per_frame = static_cast<std::uint16_t>(4 * packet.channels());
  const bool frames_first = order == SizeOrder::frames_first;
  std::string bytes(kPreamble);
  put(bytes, packet.article);
  put(bytes, packet.serial);
  put(bytes, packet.channel_bits);
  put(bytes, packet.status);
  put(bytes, frames_first ? frames : bytes_per_frame);
  put(bytes, frames_first ? bytes_per_frame : frames);
  put(bytes, packet.counter);
  for (const std::int32_t value : packet.values) put(bytes, value);
  return bytes;
}

void PacketParser::add(std::string_view bytes) {
  if (begin_ > kKeep || begin_ == bytes_.size()) {
    bytes_.erase(0, begin_);
    begin_ = 0;
  }
  bytes_ += bytes;
}

bool PacketParser::next(Packet& packet) {
  for (;;) {
    const std::string_view rest = std::string_view(bytes_).substr(begin_);
    const std::size_t found = rest.find(kPreamble);
    if (found == std::string_view::npos) {
      // The last bytes may be the beginning of the next preamble, so they are kept.
      const std::size_t tail = kPreamble.size() - 1;
      std::size_t keep = rest.size() < tail ? rest.size() : tail;
      while (!kPreamble.starts_with(rest.substr(rest.size() - keep))) --keep;
      skip(rest.size() - keep);
      return false;
    }
    skip(found);
    std::size_t size = 0;
    if (!parse_at(begin_, packet, size)) {
      if (size == 0) return false;
      skip(1);
      continue;
    }
    packet.after_garbage = skipped_now_ > 0;
    take(size);
    return true;
  }
}

// Returns false with size 0 if more bytes are needed, and with size > 0 if no packet begins here.
bool PacketParser::parse_at(std::size_t at, Packet& packet, std::size_t& size) const {
  const std::string_view bytes = std::string_view(bytes_).substr(at);
  size = 0;
  if (bytes.size() < kHeaderBytes) return false;
  packet.article = get<std::int32_t>(bytes, 4);
  packet.serial = get<std::int32_t>(bytes, 8);
  packet.channel_bits = get<std::uint64_t>(bytes, 12);
  packet.status = get<std::uint32_t>(bytes, 20);
  packet.counter = get<std::uint32_t>(bytes, 28);
  const auto sizes = sizes_of(bytes);
  if (!sizes || !known(packet)) {
    size = 1;
    return false;
  }
  const std::size_t whole = kHeaderBytes + sizes->frames * sizes->bytes_per_frame;
  if (bytes.size() < whole) return false;
  // A value has only 24 bits, so a value cannot contain a preamble. Therefore this packet was
  // truncated.
  if (bytes.substr(kHeaderBytes, whole - kHeaderBytes).find(kPreamble) != std::string_view::npos) {
    size = 1;
    return false;
  }
  packet.values.resize((whole - kHeaderBytes) / 4);
  for (std::size_t i = 0; i < packet.values.size(); ++i)
    packet.values[i] = get<std::int32_t>(bytes, kHeaderBytes + 4 * i);
  size = whole;
  return true;
}

bool PacketParser::known(const Packet& packet) const {
  if (skipped_now_ == 0) return true;  // no bytes were skipped, so a packet must begin here
  return !article_ || (packet.article == *article_ && packet.serial == *serial_);
}

void PacketParser::skip(std::size_t bytes) {
  begin_ += bytes;
  skipped_ += bytes;
  skipped_now_ += bytes;
}

void PacketParser::take(std::size_t bytes) {
  const std::string_view header = std::string_view(bytes_).substr(begin_);
  article_ = get<std::int32_t>(header, 4);
  serial_ = get<std::int32_t>(header, 8);
  begin_ += bytes;
  skipped_now_ = 0;
}

void PacketParser::reset() {
  *this = PacketParser();
}

double to_um(std::int32_t raw, double range_um) {
  return static_cast<double>(raw) / kFullScale * range_um;
}

bool at_end_of_range(std::int32_t raw, std::int32_t guard) {
  return raw <= guard || raw >= kFullScale - guard;
}

}  // namespace mdof::drivers::capancdt
