// Measures the length of a tick of a device that does not state it exactly.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// The manual states a tick of 1/512 s, 1/256 s or 1.90 ms on different pages. These values differ
// too much for DeviceClock, which assumes that a clock deviates by at most 0.1 %. The length is
// measured between the quickest packet at the beginning of the stream and the quickest packet just
// before 0.5, 1, 2 ... 64 s. A new value is used if it differs by more than a delay of 10 ms
// explains. Pure.
class TickLength {
 public:
  explicit TickLength(double nominal_ns) : ns_(nominal_ns) {}
  // A packet was received whose newest line has the stamp `ticks` (growing).
  void add(std::int64_t ticks, std::int64_t received_ns);
  // A new stream begins; the measured length is kept.
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
