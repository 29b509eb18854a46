// The time of a device on the host's monotonic clock, by a robust fit.
//
// A packet is received after it was sent, by a delay that is at best small and varies upwards. In
// each stretch of device time the packet that came soonest counts; through these goes a line by
// the median of all slopes (Theil 1950, Sen 1968), which neither late packets nor a stretch without
// a quick one can pull. Its offset from the nominal rate is the drift of the two clocks. What is
// given out follows the line without steps and never goes backwards. The least delay itself cannot
// be seen from here; it shifts all times of a device alike.
//
// Packets that come late for a while, and a device whose time stood still, look the same as long as
// it lasts. The line is kept, so that times are right if it is the link that is slow, and the clock
// is uncertain until packets are in time again; what has been late for a minute is taken for a
// step. After a step, which moves the times, it is uncertain until the line is known anew.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace mdof::drivers {

struct ClockState {
  double drift_ppm = 0;        // the device's clock fast against the host's: > 0
  std::int64_t jitter_ns = 0;  // spread of the delays in a quarter of a second
  bool settled = false;        // the drift is known; before, the nominal rate is taken for true
  std::uint64_t steps = 0;     // times the device's clock jumped: it was restarted, or lost count
  // The times given out now may be wrong, by about so much: packets are late, or the clock stepped
  // and has not settled yet.
  bool doubtful = false;
  std::int64_t late_ns = 0;
};

// Pure: all times are handed in, so the same calls give the same bits. Thread-bound.
class DeviceClock {
 public:
  // Of one tick of the device's time.
  explicit DeviceClock(double nominal_tick_ns);

  // A packet whose newest sample has device time `ticks` (unwrapped, growing) was received.
  void add(std::int64_t ticks, std::int64_t received_ns);
  // Host time of a sample; after the first add(). Strictly growing with ticks, for those from the
  // last call on.
  std::int64_t host_ns(std::int64_t ticks);
  // Forgets everything: the device was opened again.
  void reset();

  ClockState state() const;
  // Of state(), what is looked at with each block.
  bool doubtful() const;
  std::uint64_t steps() const { return steps_; }

 private:
  struct Best {  // of a stretch
    std::int64_t stretch, ticks, received_ns;
    double offset_ns;  // received - nominal time
    double latest_ns;  // largest offset in the stretch
  };
  double nominal_ns(std::int64_t ticks) const;
  void fit();
  void step(std::int64_t ticks, std::int64_t received_ns);
  bool is_late(double offset_ns, double nominal_ns, std::int64_t received_ns);
  void take(std::int64_t ticks, std::int64_t received_ns, double offset_ns, double nominal_ns);

  double tick_ns_;
  std::deque<Best> best_;
  std::size_t unfitted_ = 0;  // stretches that the line does not know yet
  std::optional<std::int64_t> first_ticks_, first_ns_, last_ticks_;
  double slope_ = 0, intercept_ns_ = 0;  // of the offset against nominal time
  std::int64_t given_ticks_ = 0;
  double given_offset_ns_ = 0;
  std::int64_t given_ns_ = INT64_MIN;
  bool fitted_ = false, given_any_ = false;
  std::size_t uncertain_stretches_ = 0;  // after a step
  double late_ns_ = 0;                   // the newest packet, while packets are late
  std::optional<std::int64_t> late_since_ns_;
  std::uint64_t steps_ = 0;
};

}  // namespace mdof::drivers
