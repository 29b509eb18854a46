// The place of each packet in the sequence of all frames, from the counter in its header. Pure.
//
// The manual calls it "measuring value counter (of 1st frame)" and leaves open what it counts. It
// is learned from the packets themselves: what most steps agree with is taken. Again when the set
// of channels changes, or when packets overlap, as only a wrong reading of the counter can make
// them. Before it is known, packets are held back.
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
  sample,  // + M x n: all samples, of which arithmetic averaging sends the mean of each n
  packet,  // + 1
};
inline constexpr int kCounterUnits = 4;

struct PlacedPacket {
  Packet packet;
  std::int64_t first_frame = 0;  // 0: that of the first packet; lost ones are counted
  std::uint64_t lost = 0;        // frames just before it
};

// Thread-bound.
class FrameCounter {
 public:
  // `averaged` samples are in a frame (1: all are sent). More than `most_lost` frames in a row are
  // no loss but a counter that was set anew.
  FrameCounter(int averaged, std::uint64_t most_lost);

  // Appends to `placed` what can be placed now: none, this, or all that was held back. A packet
  // that came before is dropped. Error: the counter jumped, or counts nothing that is known; of no
  // more use then.
  Status add(Packet packet, std::deque<PlacedPacket>& placed);

  std::optional<CounterUnit> unit() const { return unit_; }
  std::uint64_t duplicates() const { return duplicates_; }
  std::uint64_t lost() const { return lost_; }

 private:
  struct Last {  // packet that was placed
    Packet packet;
    std::int64_t first_frame;
  };
  std::uint64_t step(const Packet& packet, CounterUnit unit) const;  // to the next
  double frames(std::uint64_t counted, const Packet& before) const;
  Status hold(Packet packet, std::deque<PlacedPacket>& placed);
  void vote(const Packet& before, const Packet& packet);
  Status place(Packet packet, std::deque<PlacedPacket>& placed);
  bool came_before(const Packet& last, const Packet& packet) const;
  Status drop_duplicate(const Packet& last, const Packet& packet);

  int averaged_;
  std::uint64_t most_lost_;
  std::optional<CounterUnit> unit_;  // none: being learned
  std::array<int, kCounterUnits> votes_{};
  std::vector<Packet> held_;
  std::optional<Last> last_;
  int duplicates_in_a_row_ = 0;
  std::uint64_t duplicates_ = 0, lost_ = 0;
};

}  // namespace mdof::drivers::capancdt
