#include "drivers/pokeys57u/protocol.h"

#include <algorithm>
#include <charconv>

namespace mdof::drivers::pokeys57u {
namespace {

// Offsets in a frame.
constexpr std::size_t kStart = 0, kCommand = 1, kParameter = 2, kId = 6, kSum = 7, kData = 8;
// Offsets in the data.
constexpr std::size_t kSerial = 12 - kData, kHardware = 18 - kData;

std::uint8_t byte_at(std::string_view bytes, std::size_t i) {
  return static_cast<std::uint8_t>(bytes[i]);
}

std::uint8_t checksum(std::string_view bytes) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < kSum; ++i) sum += byte_at(bytes, i);
  return static_cast<std::uint8_t>(sum);
}

std::uint32_t little(const std::uint8_t* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | bytes[i];
  return value;
}
void put_little(std::uint8_t* bytes, std::uint32_t value) {
  for (int i = 0; i < 4; ++i) bytes[i] = static_cast<std::uint8_t>(value >> 8 * i);
}

bool newer_board(const Frame& reply) {
  const std::string_view mark(reinterpret_cast<const char*>(reply.data.data()), 4);
  return mark == "PK58" || mark == "PKEx";
}

}  // namespace

std::string wrap(Way way, const Frame& frame) {
  std::string bytes(kFrameBytes, '\0');
  bytes[kStart] = static_cast<char>(way);
  bytes[kCommand] = static_cast<char>(frame.command);
  std::copy(frame.parameter.begin(), frame.parameter.end(), bytes.begin() + kParameter);
  bytes[kId] = static_cast<char>(frame.id);
  bytes[kSum] = static_cast<char>(checksum(bytes));
  std::copy(frame.data.begin(), frame.data.end(), bytes.begin() + kData);
  return bytes;
}

std::optional<Frame> unwrap(Way way, std::string_view bytes) {
  if (bytes.size() != kFrameBytes || byte_at(bytes, kStart) != static_cast<std::uint8_t>(way) ||
      byte_at(bytes, kSum) != checksum(bytes))
    return std::nullopt;
  Frame frame;
  frame.command = byte_at(bytes, kCommand);
  frame.id = byte_at(bytes, kId);
  for (std::size_t i = 0; i < frame.parameter.size(); ++i)
    frame.parameter[i] = byte_at(bytes, kParameter + i);
  for (std::size_t i = 0; i < kDataBytes; ++i) frame.data[i] = byte_at(bytes, kData + i);
  return frame;
}

Frame request(Command command, std::uint8_t parameter) {
  Frame frame;
  frame.command = command;
  frame.parameter[0] = parameter;
  return frame;
}

std::string Identity::model() const {
  switch (hardware) {
    case 10:
      return "PoKeys56U";
    case 28:
      return "PoKeys57U";
    case 30:
      return "PoKeys57U v1.1";
    case 32:
      return "PoKeys57CNC";
    default:
      return "PoKeys";
  }
}

Identity identity_of(const Frame& reply) {
  const auto& p = reply.parameter;
  Identity identity;
  const int major = (p[2] >> 4) + 1, middle = p[2] & 0xF, minor = p[3];
  identity.firmware =
      std::to_string(major) + "." + std::to_string(middle) + "." + std::to_string(minor);
  if (newer_board(reply)) {
    identity.serial = little(&reply.data[kSerial]);
    identity.hardware = reply.data[kHardware];
  } else {
    identity.serial = static_cast<std::uint32_t>(p[0] << 8 | p[1]);
  }
  return identity;
}

bool may_be_serial(std::string_view text, std::uint32_t serial) {
  while (!text.empty()) {
    const std::size_t dot = std::min(text.find('.'), text.size());
    std::uint32_t part = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + dot, part);
    if (error == std::errc() && stop == text.data() + dot && part == serial) return true;
    text.remove_prefix(std::min(dot + 1, text.size()));
  }
  return false;
}

Counts counts_of(const Frame& reply) {
  Counts counts{};
  for (std::size_t i = 0; i < counts.size(); ++i)
    counts[i] = static_cast<std::int32_t>(little(&reply.data[4 * i]));
  return counts;
}

void set_counts(Frame& reply, const Counts& counts) {
  for (std::size_t i = 0; i < counts.size(); ++i)
    put_little(&reply.data[4 * i], static_cast<std::uint32_t>(counts[i]));
}

Codes analogue_of(const Frame& reply) {
  Codes raw{};
  for (std::size_t i = 0; i < raw.size(); ++i)
    raw[i] = static_cast<std::uint16_t>(reply.data[2 * i] << 8 | reply.data[2 * i + 1]);
  return raw;
}

void set_analogue(Frame& reply, const Codes& raw) {
  for (std::size_t i = 0; i < raw.size(); ++i) {
    reply.data[2 * i] = static_cast<std::uint8_t>(raw[i] >> 8);
    reply.data[2 * i + 1] = static_cast<std::uint8_t>(raw[i]);
  }
}

std::uint32_t tick_of(const Frame& reply) {
  return little(reply.parameter.data());
}

void set_tick(Frame& reply, std::uint32_t tick_ms) {
  put_little(reply.parameter.data(), tick_ms);
}

bool RequestIds::free(std::uint8_t id, std::int64_t now_ns) const {
  return pending_since_[id] == kNotPending || now_ns - pending_since_[id] >= kLatest_ns;
}

std::uint8_t RequestIds::next(std::int64_t now_ns) {
  ++last_;
  for (int tries = 0; tries < 256 && !free(last_, now_ns); ++tries) ++last_;
  if (!free(last_, now_ns)) {
    const auto oldest = std::min_element(pending_since_.begin(), pending_since_.end());
    last_ = static_cast<std::uint8_t>(oldest - pending_since_.begin());
  }
  pending_since_[last_] = now_ns;
  return last_;
}

}  // namespace mdof::drivers::pokeys57u
