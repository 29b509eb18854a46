// Measures the length of a tick of the device's clock, because the manual does not state it
// consistently.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// The manual states a tick of 1/512 s, 1/256 s or 1.90 ms on different pages. These values differ
// too much for DeviceClock, which assumes that the rate of a clock is wrong by at most 0.1 %.
// Therefore the length is measured between two packets of the stream. The first is the packet with
// the smallest delay at the beginning. The second is the packet with the smallest delay shortly
// before the stream is 0.5, 1, 2 ... 64 s old. The measured length replaces the old length if the
// difference is larger than a delay of 10 ms can cause. Pure.
class TickLength {
 public:
  explicit TickLength(double nominal_ns) : ns_(nominal_ns) {}
  // Call this when a packet was received. `ticks`: stamp of its newest line; it increases from
  // packet to packet.
  void add(std::int64_t ticks, std::int64_t received_ns);
  // A new stream begins. The measured length is kept.
  void restart();
  double ns() const { return ns_; }

 private:
  struct Packet {
    std::int64_t ticks = 0, received_ns = 0;
    bool any = false;
  };
  void keep_quickest(Packet& best, std::int64_t ticks, std::int64_t received_ns) const;

  double ns_;
  Packet first_, early_, late_;
  std::int64_t span_ns_ = 500'000'000;
};

}  // namespace mdof::drivers
