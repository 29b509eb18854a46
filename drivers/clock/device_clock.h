// Converts the time of a device to the host's monotonic clock by a robust line fit.
//
// A packet is received after it was sent. The delay is small at best and only ever larger. In each
// stretch of device time only the packet with the smallest delay is used. A line is fitted to these
// packets with the median of all slopes (Theil 1950, Sen 1968), so neither late packets nor a
// stretch without a quick packet change it much. Its slope relative to the nominal rate is the
// drift between the two clocks. The returned times follow the line without steps and never
// decrease. The smallest delay itself cannot be observed; it shifts all times of a device equally.
//
// Packets that are late for a while cannot be distinguished from a device clock that stood still,
// as long as the state lasts. The line is kept, so times are right if only the link is slow, and
// the clock is flagged uncertain until packets are in time again. If packets are late for a minute,
// this is treated as a step of the device clock. After a step, which shifts the times, the clock is
// uncertain until a new line is fitted.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace mdof::drivers {

struct ClockState {
  double drift_ppm = 0;        // > 0: the device's clock is faster than the host's
  std::int64_t jitter_ns = 0;  // spread of the delays within a quarter of a second
  bool settled = false;        // the drift is known; before that, the nominal rate is used
  std::uint64_t steps = 0;     // how often the device's clock jumped: a restart or a lost count
  // Returned times may be wrong by about late_ns: packets are late, or the clock has stepped and
  // has not settled yet.
  bool doubtful = false;
  std::int64_t late_ns = 0;
};

// Pure: the caller gives all times, so the same calls give the same bits. Thread-bound.
class DeviceClock {
 public:
  // `nominal_tick_ns`: length of one tick of the device's time.
  explicit DeviceClock(double nominal_tick_ns);

  // Reports that a packet was received whose newest sample has device time `ticks` (unwrapped,
  // growing).
  void add(std::int64_t ticks, std::int64_t received_ns);
  // Host time of a sample. Call add() first. Strictly growing with `ticks` from the last call on.
  std::int64_t host_ns(std::int64_t ticks);
  // Forgets the fit, because the device was opened again. Returned times still never decrease, and
  // the steps are kept.
  void reset();

  ClockState state() const;
  // The parts of state() that are read for each block.
  bool doubtful() const;
  std::uint64_t steps() const { return steps_; }

 private:
  struct Best {  // quickest packet of a stretch
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
  std::size_t unfitted_ = 0;  // stretches that the line does not contain yet
  std::optional<std::int64_t> first_ticks_, first_ns_, last_ticks_;
  double slope_ = 0, intercept_ns_ = 0;  // line of the offset against nominal time
  std::int64_t returned_ticks_ = 0;
  double returned_offset_ns_ = 0;
  std::int64_t returned_ns_ = INT64_MIN;
  bool fitted_ = false, has_returned_time_ = false;
  std::size_t uncertain_stretches_ = 0;  // stretches after a step until the clock is certain
  double late_ns_ = 0;                   // delay of the newest packet against the line, if late
  std::optional<std::int64_t> late_since_ns_;
  std::uint64_t steps_ = 0;
};

}  // namespace mdof::drivers
