// Lines of a US Digital QSB-D/QSB-S (QSB Command List v1.28). Pure; accepts any bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::drivers {

namespace qsb {
enum Register : std::uint8_t {
  kMdr0 = 0x03,  // bits 0-1: 1 x1, 2 x2, 3 x4; the rest 0: free running, index off
  kMdr1 = 0x04,  // 0: counts up, enabled, no triggers
  kStatus = 0x06,
  kLoad = 0x08,  // DTR: the count that the index loads
  kThreshold = 0x0B,
  kInterval = 0x0C,  // of the stream, in ticks
  kStamp = 0x0D,     // 1: restart at 0
  kCount = 0x0E,
  kVersion = 0x14,
  kEor = 0x15,
  kCommand = 0x16,  // 1: stop streaming
};
inline constexpr std::uint32_t kPowerWasLost = 0x04;  // bit of kStatus
// Bits of kMdr0: the index loads the count from kLoad, synchronously with A and B, which is one
// count wide.
inline constexpr std::uint32_t kIndexLoads = 0x10, kIndexSynchronous = 0x40;
inline constexpr std::uint32_t kIndexInverted = 0x08;  // bit of kMdr1
inline constexpr std::uint32_t kEorLf = 1, kEorCr = 2, kEorStamp = 4, kEorSpaces = 8;
inline constexpr std::uint32_t kFullLines = kEorLf | kEorCr | kEorStamp | kEorSpaces;
inline constexpr double kTick_ns = 1e9 / 512;  // nominal; the manual contradicts itself
}  // namespace qsb

struct QsbReply {
  char type = 0;  // r w s: done; e: value refused; x: not supported
  std::uint8_t reg = 0;
  std::uint32_t data = 0;
  std::optional<std::uint32_t> stamp;
  bool operator==(const QsbReply&) const = default;
};

// A command 'R', 'W' or 'S' with its line end.
std::string qsb_command(char type, std::uint8_t reg,
                        std::optional<std::uint32_t> data = std::nullopt);
// A line, with its end, from a device whose EOR register is `eor`.
std::string qsb_line(const QsbReply& reply, std::uint32_t eor = qsb::kFullLines);
// `line`: without its end; fields separated by one space each, with or without a stamp. nullopt:
// the line is malformed, truncated or a banner.
std::optional<QsbReply> parse_qsb_line(std::string_view line);
// The text that a device sends after a reset; undocumented, observed as "QSB-D  0E!".
bool is_qsb_banner(std::string_view line);

struct QsbIdentity {
  std::string serial;  // five digits
  std::string model;   // "QSB-D", "QSB-M", "QSB-S", "QSB"
  int firmware = 0;
};
QsbIdentity qsb_identity(std::uint32_t version);

}  // namespace mdof::drivers
