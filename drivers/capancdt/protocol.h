// The data port of a capaNCDT 6200: bytes <-> packets of measuring values. Pure.
//
// Source: capaNCDT 6200 operating instructions, "Data format of measuring values": a header of 32
// bytes and M frames, all little-endian; a frame is one 32-bit value of each available channel,
// lowest channel first. The manual does not say which of the two size words (frames, bytes of a
// frame) comes first; as the bytes of a frame are 4 for each channel, either order is understood.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers::capancdt {

inline constexpr int kMostChannels = 32;  // two bits of 64 each
inline constexpr int kMostFrames = 1024;  // in a packet; more is taken for garbage
inline constexpr std::size_t kHeaderBytes = 32;
inline constexpr std::int32_t kFullScale = 0xFFFFFF;

struct Packet {
  std::int32_t article = 0, serial = 0;  // "of the sensor", says the manual
  std::uint64_t channel_bits = 0;        // two a channel, channel 1 lowest; 01: available
  std::uint32_t status = 0;              // not used
  std::uint32_t counter = 0;             // of the first frame
  std::vector<std::int32_t> values;      // [frame][available channel]
  bool after_garbage = false;            // bytes that are no packet came before it

  int channels() const;                           // in a frame
  int frames() const;                             // values.size() is a multiple of channels()
  std::optional<int> position(int number) const;  // of channel 1 ... 32 in a frame
  std::int32_t value(int frame, int position) const {
    return values[static_cast<std::size_t>(frame) * static_cast<std::size_t>(channels()) +
                  static_cast<std::size_t>(position)];
  }
};

std::uint64_t channel_bit(int number);  // of the available channel 1 ... 32

// Which of the two size words is at byte 24.
enum class SizeOrder { bytes_per_frame_first, frames_first };
std::string encode(const Packet& packet, SizeOrder order);

// Cuts the stream. Thread-bound. Any bytes do; what is no packet is skipped up to the next one,
// which must then have article and serial number of the packets before.
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
  std::size_t begin_ = 0;  // of what is not yet cut
  std::uint64_t skipped_ = 0, skipped_now_ = 0;
  std::optional<std::int32_t> article_, serial_;
};

// Manual, "Scaling of measuring values": digital value / 0xFFFFFF x range.
double to_um(std::int32_t raw, double range_um);
// A reading within `guard` counts of an end of the range, or beyond: the controller has no flag.
bool at_end_of_range(std::int32_t raw, std::int32_t guard);

}  // namespace mdof::drivers::capancdt
