// The data port of a capaNCDT 6200: conversion between bytes and packets of values. Pure.
//
// Source: capaNCDT 6200 operating instructions, "Data format of measuring values". A packet has a
// header of 32 bytes and M frames. All numbers are little-endian. A frame contains one 32-bit value
// of each available channel, lowest channel first. The header contains two size words: number of
// frames and bytes of a frame. The manual does not state which size word comes first. The parser
// detects the order, because a frame has 4 bytes for each channel.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace mdof::drivers::capancdt {

inline constexpr int kMostChannels = 32;  // the header has 64 bits, two for each channel
// Largest number of frames in a packet; a packet with more frames is invalid.
inline constexpr int kMostFrames = 1024;
inline constexpr std::size_t kHeaderBytes = 32;
inline constexpr std::int32_t kFullScale = 0xFFFFFF;

struct Packet {
  std::int32_t article = 0, serial = 0;  // numbers "of the sensor", according to the manual
  std::uint64_t channel_bits = 0;    // two bits for each channel, channel 1 lowest; 01: available
  std::uint32_t status = 0;          // not used
  std::uint32_t counter = 0;         // counter of the first frame
  std::vector<std::int32_t> values;  // [frame][available channel]
  bool after_garbage = false;        // true: invalid bytes came before this packet

  int channels() const;  // number of channels in a frame
  int frames() const;    // number of frames; values.size() is a multiple of channels()
  // Index of channel `number` (1 to 32) in a frame; nullopt: the frame does not contain the
  // channel.
  std::optional<int> position(int number) const;
  std::int32_t value(int frame, int position) const {
    return values[static_cast<std::size_t>(frame) * static_cast<std::size_t>(channels()) +
                  static_cast<std::size_t>(position)];
  }
};

std::uint64_t channel_bit(int number);  // bit that marks channel 1 ... 32 as available

// Order of the two size words, which begin at byte 24.
enum class SizeOrder { bytes_per_frame_first, frames_first };
std::string encode(const Packet& packet, SizeOrder order);

// Divides the stream into packets. Thread-bound. Accepts any bytes. Skips invalid bytes until the
// next packet, which must have the article number and the serial number of the earlier packets.
class PacketParser {
 public:
  void add(std::string_view bytes);
  bool next(Packet& packet);  // false: more bytes are needed for a packet

  std::uint64_t skipped() const { return skipped_; }  // number of skipped bytes since reset()
  // Number of skipped bytes since the last packet.
  std::uint64_t skipped_now() const { return skipped_now_; }
  void reset();

 private:
  bool parse_at(std::size_t at, Packet& packet, std::size_t& size) const;
  bool known(const Packet& packet) const;
  void skip(std::size_t bytes);
  void take(std::size_t bytes);

  std::string bytes_;
  std::size_t begin_ = 0;  // first byte that was not processed yet
  std::uint64_t skipped_ = 0, skipped_now_ = 0;
  std::optional<std::int32_t> article_, serial_;
};

// Range x digital value / 0xFFFFFF (manual, "Scaling of measuring values").
double to_um(std::int32_t raw, double range_um);
// Whether a reading is at most `guard` counts from an end of the range, or beyond it. The
// controller sends no flag for such readings.
bool at_end_of_range(std::int32_t raw, std::int32_t guard);

}  // namespace mdof::drivers::capancdt
