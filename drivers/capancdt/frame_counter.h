// Numbers the packets in the sequence of all frames, from the counter in their headers. Pure.
//
// The manual calls the counter "measuring value counter (of 1st frame)" and does not state what it
// counts. The unit is learned from the packets: the unit that agrees with most steps is used. It is
// learned again if the set of channels changes or if packets overlap, which only a wrong unit can
// cause. Packets are held back until the unit is known.
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
  frame,   // + M from a packet of M frames to the next
  value,   // + M x channels
  sample,  // + M x n: arithmetic averaging sends the mean of n samples
  packet,  // + 1
};
inline constexpr int kCounterUnits = 4;

struct PlacedPacket {
  Packet packet;
  std::int64_t first_frame = 0;  // number; 0: first frame of the first packet; lost frames count
  std::uint64_t lost = 0;        // number of frames lost before this packet
};

// Thread-bound.
class FrameCounter {
 public:
  // `averaged`: number of samples in a frame (1: no averaging). If more than `most_lost` frames in
  // a row are missing, the counter was reset.
  FrameCounter(int averaged, std::uint64_t most_lost);

  // Appends the packets that can be numbered now to `placed`: none, this packet, or all packets
  // that were held back. Drops duplicates. Error: the counter jumped, or its unit is unknown; the
  // object is then unusable.
  Status add(Packet packet, std::deque<PlacedPacket>& placed);

  std::optional<CounterUnit> unit() const { return unit_; }
  std::uint64_t duplicates() const { return duplicates_; }
  std::uint64_t lost() const { return lost_; }

 private:
  struct Last {  // the last numbered packet
    Packet packet;
    std::int64_t first_frame;
  };
  std::uint64_t step(const Packet& packet, CounterUnit unit) const;  // to the next packet
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
