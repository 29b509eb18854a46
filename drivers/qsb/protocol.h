// Reads and writes the lines of a US Digital QSB-D/QSB-S (QSB Command List v1.28). Pure; accepts
// any bytes.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::drivers {

namespace qsb {
enum Register : std::uint8_t {
  kMdr0 = 0x03,  // bits 0 and 1: 1 is x1, 2 is x2, 3 is x4; other bits 0: free running, index off
  kMdr1 = 0x04,  // 0: counts up, counter enabled, no triggers
  kStatus = 0x06,
  kLoad = 0x08,  // register DTR: number to which the index sets the count
  kThreshold = 0x0B,
  kInterval = 0x0C,  // interval of the stream, in ticks
  kStamp = 0x0D,     // writing 1 restarts the stamp at 0
  kCount = 0x0E,
  kVersion = 0x14,
  kEor = 0x15,
  kCommand = 0x16,  // writing 1 stops the stream
};
inline constexpr std::uint32_t kPowerWasLost = 0x04;  // bit of kStatus
// Bits of kMdr0. kIndexLoads: the index signal sets the count to the number in kLoad.
// kIndexSynchronous: the index signal is combined with A and B, so that it is one count wide.
inline constexpr std::uint32_t kIndexLoads = 0x10, kIndexSynchronous = 0x40;
inline constexpr std::uint32_t kIndexInverted = 0x08;  // bit of kMdr1
inline constexpr std::uint32_t kEorLf = 1, kEorCr = 2, kEorStamp = 4, kEorSpaces = 8;
inline constexpr std::uint32_t kFullLines = kEorLf | kEorCr | kEorStamp | kEorSpaces;
// Nominal length of a tick; the manual also states other values (tick_length.h).
inline constexpr double kTick_ns = 1e9 / 512;
}  // namespace qsb

struct QsbReply {
  char type = 0;  // r, w or s: done; e: the value was rejected; x: not supported
  std::uint8_t reg = 0;
  std::uint32_t data = 0;
  std::optional<std::uint32_t> stamp;
  bool operator==(const QsbReply&) const = default;
};

// Returns the command 'R', 'W' or 'S' with its line end.
std::string qsb_command(char type, std::uint8_t reg,
                        std::optional<std::uint32_t> data = std::nullopt);
// Returns the line, with its end, that a device sends if its EOR register contains `eor`.
std::string qsb_line(const QsbReply& reply, std::uint32_t eor = qsb::kFullLines);
// Parses a line without its end. Its fields are separated by one space each; the stamp may be
// missing. nullopt: the line is malformed, truncated or a banner.
std::optional<QsbReply> parse_qsb_line(std::string_view line);
// Whether the line is the text that a device sends after a reset. This text is not documented; it
// was observed as "QSB-D  0E!".
bool is_qsb_banner(std::string_view line);

struct QsbIdentity {
  std::string serial;  // five digits
  std::string model;   // "QSB-D", "QSB-M", "QSB-S", "QSB"
  int firmware = 0;
};
QsbIdentity qsb_identity(std::uint32_t version);

}  // namespace mdof::drivers
