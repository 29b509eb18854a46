// Numbers all frames, including lost frames, by means of the counter in the headers of the packets.
// Pure.
//
// The manual calls the counter "measuring value counter (of 1st frame)" and does not state its
// unit. The class derives the unit from the packets: it uses the unit that agrees with most of the
// steps from packet to packet. It derives the unit again if the set of channels changes. It also
// does this if packets overlap, because packets overlap only if the unit is wrong. Packets are kept
// back until the unit is known.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "drivers/capancdt/protocol.h"
#include "schema/base/result.h"

namespace mdof::drivers::capancdt {

enum class CounterUnit {
  frame,   // increases by M after a packet of M frames
  value,   // increases by M x number of channels
  sample,  // increases by M x n; with arithmetic averaging a frame is the mean of n samples
  packet,  // increases by 1
};
inline constexpr int kCounterUnits = 4;

struct PlacedPacket {
  Packet packet;
  std::int64_t first_frame = 0;  // 0: first frame of the first packet; lost frames are counted too
  std::uint64_t lost = 0;        // number of frames lost before this packet
};

// Thread-bound.
class FrameCounter {
 public:
  // `averaged`: number of samples in a frame (1: no averaging). `most_lost`: largest number of
  // successive missing frames; if more frames are missing, the counter was reset.
  FrameCounter(int averaged, std::uint64_t most_lost);

  // Appends the packets that can be numbered now to `placed`: no packet, this packet, or all
  // packets that were kept back. If a packet arrives twice, discards the second copy. Error: the
  // counter jumped, or its unit cannot be found. The object must not be used after an error.
  Status add(Packet packet, std::deque<PlacedPacket>& placed);

  std::optional<CounterUnit> unit() const { return unit_; }
  std::uint64_t duplicates() const { return duplicates_; }
  std::uint64_t lost() const { return lost_; }

 private:
  struct Last {  // the last numbered packet
    Packet packet;
    std::int64_t first_frame;
  };
  // Increase of the counter from this packet to the next packet, if the counter counts in `unit`.
  std::uint64_t step(const Packet& packet, CounterUnit unit) const;
  double frames(std::uint64_t counted, const Packet& before) const;
  Status hold(Packet packet, std::deque<PlacedPacket>& placed);
  void vote(const Packet& before, const Packet& packet);
  Status place(Packet packet, std::deque<PlacedPacket>& placed);
  bool is_duplicate(const Packet& last, const Packet& packet) const;
  Status drop_duplicate(const Packet& last, const Packet& packet);

  int averaged_;
  std::uint64_t most_lost_;
  std::optional<CounterUnit> unit_;  // nullopt: not known yet
  std::array<int, kCounterUnits> votes_{};
  std::vector<Packet> held_;
  std::optional<Last> last_;
  int duplicates_in_a_row_ = 0;
  std::uint64_t duplicates_ = 0, lost_ = 0;
};

}  // namespace mdof::drivers::capancdt
