// How long a tick of a device is that does not say so exactly.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// The manual's tick is 1/512 s, 1/256 s or 1.90 ms, by the page: too far apart for DeviceClock,
// which takes a clock for at most 0.1 % wrong. The length is measured between the quickest packet
// of the stream's beginning and the quickest just before 0.5, 1, 2 ... 64 s of it; a new value
// counts where it differs by more than 10 ms of delay could explain. Pure.
class TickLength {
 public:
  explicit TickLength(double nominal_ns) : ns_(nominal_ns) {}
  // A packet whose newest line has the stamp `ticks` (growing) was received.
  void add(std::int64_t ticks, std::int64_t received_ns);
  // A new stream begins; what was learned stays.
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
