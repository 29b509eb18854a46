// The data port of a capaNCDT 6200: bytes <-> packets of values. Pure.
//
// Source: capaNCDT 6200 operating instructions, "Data format of measuring values": a header of 32
// bytes and M frames, all little-endian. A frame contains one 32-bit value of each available
// channel, lowest channel first. The manual does not state which of the two size words (frames,
// bytes of a frame) comes first. A frame has 4 bytes for each channel, so the parser detects the
// order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers::capancdt {

inline constexpr int kMostChannels = 32;  // 64 bits, two for each channel
inline constexpr int kMostFrames = 1024;  // in a packet; a higher number is invalid
inline constexpr std::size_t kHeaderBytes = 32;
inline constexpr std::int32_t kFullScale = 0xFFFFFF;

struct Packet {
  std::int32_t article = 0, serial = 0;  // "of the sensor", according to the manual
  std::uint64_t channel_bits = 0;        // two for each channel, channel 1 lowest; 01: available
  std::uint32_t status = 0;              // not used
  std::uint32_t counter = 0;             // counter at the first frame
  std::vector<std::int32_t> values;      // [frame][available channel]
  bool after_garbage = false;            // invalid bytes came before this packet

  int channels() const;                           // number in a frame
  int frames() const;                             // values.size() is a multiple of channels()
  std::optional<int> position(int number) const;  // index of channel 1 ... 32 in a frame
  std::int32_t value(int frame, int position) const {
    return values[static_cast<std::size_t>(frame) * static_cast<std::size_t>(channels()) +
                  static_cast<std::size_t>(position)];
  }
};

std::uint64_t channel_bit(int number);  // bit of an available channel 1 ... 32

// The size word at byte 24.
enum class SizeOrder { bytes_per_frame_first, frames_first };
std::string encode(const Packet& packet, SizeOrder order);

// Cuts the stream into packets. Thread-bound. Accepts any bytes. Skips invalid bytes up to the next
// packet, which must have the same article and serial number as earlier packets.
class PacketParser {
 public:
  void add(std::string_view bytes);
  bool next(Packet& packet);  // false: more bytes are needed

  std::uint64_t skipped() const { return skipped_; }          // bytes, since reset()
  std::uint64_t skipped_now() const { return skipped_now_; }  // since the last packet
  void reset();

 private:
  bool parse_at(std::size_t at, Packet& packet, std::size_t& size) const;
  bool known(const Packet& packet) const;
  void skip(std::size_t bytes);
  void take(std::size_t bytes);

  std::string bytes_;
  std::size_t begin_ = 0;  // first byte that is not yet processed
  std::uint64_t skipped_ = 0, skipped_now_ = 0;
  std::optional<std::int32_t> article_, serial_;
};

// Manual, "Scaling of measuring values": digital value / 0xFFFFFF x range.
double to_um(std::int32_t raw, double range_um);
// A reading within `guard` counts of an end of the range, or beyond: the controller has no flag.
bool at_end_of_range(std::int32_t raw, std::int32_t guard);

}  // namespace mdof::drivers::capancdt
