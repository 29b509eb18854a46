// Frames of PoLabs PoKeys57U and 56U. A request and a reply have 64 bytes each; at most one request
// is pending. Source: PoKeys protocol specification, 3.1.2018; bytes are numbered from 0 here.
// Pure; accepts any bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace mdof::drivers::pokeys57u {

inline constexpr std::uint16_t kVendor = 0x1DC3, kProduct = 0x1001;
// The device has three interfaces: 0 is a keyboard, 2 a joystick.
inline constexpr int kInterface = 1;
inline constexpr std::size_t kFrameBytes = 64;
inline constexpr std::size_t kDataBytes = 56;

enum Command : std::uint8_t {
  kDeviceData = 0x00,
  kAnalogue = 0x3A,
  kEncoderOptions = 0xC4,  // parameter 0: 0 reads, 1 writes
  kEncoderValues = 0xCD,   // parameter 0: number of the block
  kTick = 0xCF,            // milliseconds since the device was switched on
};
enum EncoderOption : std::uint8_t { kEnabled = 1, kCounts_x4 = 2, kCounts_x2 = 4 };

inline constexpr std::size_t kEncoders = 25;  // without the ultra-fast encoder
inline constexpr std::size_t kUltraFast = 25;
inline constexpr std::size_t kCounters = 26, kCountersPerBlock = 13;
inline constexpr std::size_t kAnalogues = 7;
inline constexpr std::uint16_t kAnalogueTop = 4095;
inline constexpr double kAnalogueTop_V = 3.3;

struct Frame {
  std::uint8_t command = 0, id = 0;
  std::array<std::uint8_t, 4> parameter{};
  std::array<std::uint8_t, kDataBytes> data{};
  bool operator==(const Frame&) const = default;
};
enum class Way : std::uint8_t { request = 0xBB, reply = 0xAA };

std::string wrap(Way way, const Frame& frame);
// nullopt: the length, the first byte or the checksum is wrong.
std::optional<Frame> unwrap(Way way, std::string_view bytes);

Frame request(Command command, std::uint8_t parameter = 0);

struct Identity {
  std::uint32_t serial = 0;
  // 28: PoKeys57U, 10: PoKeys56U, ...; 0: an older board, which does not state it.
  int hardware = 0;
  std::string firmware;  // "4.2.19"
  std::string model() const;
};
Identity identity_of(const Frame& reply);
// Whether `text` can be the USB serial string of the device `serial`. The string has the form
// "2.12345" or "12345.2"; either part may be the serial number.
bool may_be_serial(std::string_view text, std::uint32_t serial);

using Counts = std::array<std::int32_t, kCountersPerBlock>;
// Block 0 contains encoders 1 to 13; block 1 contains encoders 14 to 25 and the ultra-fast encoder.
Counts counts_of(const Frame& reply);
void set_counts(Frame& reply, const Counts& counts);
using Codes = std::array<std::uint16_t, kAnalogues>;
Codes analogue_of(const Frame& reply);  // each code is 0 ... kAnalogueTop
void set_analogue(Frame& reply, const Codes& raw);
std::uint32_t tick_of(const Frame& reply);
void set_tick(Frame& reply, std::uint32_t tick_ms);

// Chooses the numbers of requests. A number is not used again until the reply to its request has
// arrived or can no longer arrive. Therefore a late reply is never assigned to another request.
class RequestIds {
 public:
  static constexpr std::int64_t kLatest_ns = 10'000'000'000;
  // Any number of requests may be pending; if all 256 numbers are pending, the oldest number is
  // used again.
  std::uint8_t next(std::int64_t now_ns);
  void answered(std::uint8_t id) { pending_since_[id] = kNotPending; }

 private:
  static constexpr std::int64_t kNotPending = INT64_MIN;
  bool free(std::uint8_t id, std::int64_t now_ns) const;
  std::array<std::int64_t, 256> pending_since_ = [] {
    std::array<std::int64_t, 256> none{};
    none.fill(kNotPending);
    return none;
  }();
  std::uint8_t last_ = 0;
};

}  // namespace mdof::drivers::pokeys57u
