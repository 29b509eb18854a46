// Converts the time of a device to the host's monotonic clock by means of a line that is fitted
// robustly.
//
// A packet is received some time after it was sent. This delay is never less than a smallest value,
// but is often larger. The device time is divided into stretches, and only the packet with the
// smallest delay of each stretch is used. A line is fitted to these packets; its slope is the
// median of the slopes of all pairs (Theil 1950, Sen 1968). Therefore late packets, and a stretch
// in which all packets are delayed, change the line only a little. The slope of the line relative
// to the nominal rate is the drift between the two clocks. The returned times follow the line
// without steps and never decrease. The smallest delay itself cannot be observed; it shifts all
// times of a device by the same amount.
//
// A packet that arrives earlier than the line allows shows a jump of the device clock forward: a
// step. A step shifts the times. The clock is then uncertain until a new line is fitted.
//
// While packets are late, the class cannot distinguish a slow connection from a device clock that
// has stopped for a while. The line is then not changed, so that the times are correct if only the
// connection is slow. The clock is flagged as uncertain until packets arrive in time again. If
// packets are late for one minute, the class treats this as a step of the device clock.
//
// A packet is early or late if its distance from the line exceeds a limit. Before the first fit the
// limit is 100 ms. After it, the limit is 20 ms plus ten times the typical distance of the quickest
// packets from the line, but at most 100 ms. If the distance is below 100 ms, the clock ignores
// single late packets: the packets count as late only after at least eight of them, over at least
// 0.25 s, without a packet in time.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>

namespace mdof::drivers {

struct ClockState {
  double drift_ppm = 0;  // > 0: the device's clock is faster than the host's clock
  // Typical difference between the largest and the smallest delay within 0.25 s.
  std::int64_t jitter_ns = 0;
  bool settled = false;     // true: the drift is known; false: the nominal rate is used
  std::uint64_t steps = 0;  // number of jumps of the device's clock: a restart or a lost count
  // True: returned times may be wrong by about late_ns, because packets are late, or because the
  // clock has jumped and no new line is fitted yet.
  bool doubtful = false;
  std::int64_t late_ns = 0;
};

// Pure: the caller passes all times, so the same calls return the same bits. Thread-bound.
class DeviceClock {
 public:
  // `nominal_tick_ns`: length of one tick of the device's time.
  explicit DeviceClock(double nominal_tick_ns);

  // Call this when a packet was received. `ticks`: device time of the newest sample in the packet,
  // unwrapped; it increases from packet to packet.
  void add(std::int64_t ticks, std::int64_t received_ns);
  // Host time of a sample. Call add() before. If `ticks` increases from call to call, the returned
  // times increase strictly.
  std::int64_t host_ns(std::int64_t ticks);
  // Call this after the device was opened again. Discards the fitted line. The returned times still
  // never decrease, and the number of steps is kept.
  void reset();

  ClockState state() const;
  // Single members of state(), for callers that read them for each block.
  bool doubtful() const;
  std::uint64_t steps() const { return steps_; }

 private:
  struct Best {  // the packet of a stretch with the smallest delay
    std::int64_t stretch, ticks, received_ns;
    double offset_ns;  // received_ns minus nominal time
    double latest_ns;  // largest offset in the stretch
  };
  double nominal_ns(std::int64_t ticks) const;
  void fit();
  void step(std::int64_t ticks, std::int64_t received_ns);
  bool is_late(double offset_ns, double nominal_ns, std::int64_t received_ns);
  void take(std::int64_t ticks, std::int64_t received_ns, double offset_ns, double nominal_ns);

  double tick_ns_;
  std::deque<Best> best_;
  std::size_t unfitted_ = 0;  // number of stretches that were added after the last fit
  std::optional<std::int64_t> first_ticks_, first_ns_, last_ticks_;
  double slope_ = 0, intercept_ns_ = 0;  // line: offset_ns against nominal time
  std::int64_t returned_ticks_ = 0;
  double returned_offset_ns_ = 0;
  std::int64_t returned_ns_ = INT64_MIN;
  bool fitted_ = false, has_returned_time_ = false;
  // Number of stretches after a step until the clock is certain.
  std::size_t uncertain_stretches_ = 0;
  double limit_ns_;     // a packet with a larger distance from the line is early or late
  double late_ns_ = 0;  // distance of the newest packet from the line
  // Number of packets beyond the limit since the last packet in time, and the arrival of the first.
  std::size_t behind_ = 0;
  std::int64_t behind_since_ns_ = 0;
  std::optional<std::int64_t> late_since_ns_;
  std::uint64_t steps_ = 0;
};

}  // namespace mdof::drivers
