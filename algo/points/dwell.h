// Finds the stops of the axis in frames and averages the rows of each stop to a point.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <vector>

#include "algo/plausibility/encoder/encoder_jump.h"
#include "algo/plausibility/encoder/place_watch.h"
#include "algo/plausibility/noise_floor.h"
#include "algo/plausibility/probe/probe_watch.h"
#include "algo/plausibility/resolution.h"
#include "algo/plausibility/slow_stretch.h"
#include "algo/points/dwell_event.h"
#include "algo/points/motion_trace.h"
#include "algo/points/over_range.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/sample.h"

namespace mdof::algo {

// The defaults suit logs of stages that settle within a tenth of a second.
struct DwellOptions {
  // The axis is at rest if the range of the encoder's readings during `window_s` is at most this.
  // 0: the larger value of 2 µm and six standard deviations of the encoder's noise.
  double tolerance_m = 0;
  double window_s = 0.05;
  double settle_s = 0.1;  // time that is left out at the start of each stop
  // Time that is left out at the end of each stop, because readings of a filter there contain the
  // next motion.
  double leave_s = 0;
  // Shortest averaged time; a shorter stop (a reversal) is no dwell.
  double min_length_s = 0.1;
  // A travel of this length determines the direction of approach. An overrun of an end target
  // determines it, too, if the overrun exceeds both 10 µm and five tolerances.
  double approach_m = 50e-6;
  // Largest speed of the axis; positions that it cannot reach are left out.
  double max_speed_m_s = 100;
  // Largest number of scans that are averaged for a dwell; limits the memory.
  std::size_t max_scans = std::size_t{1} << 19;

  // Shortest stop that becomes a dwell.
  double shortest_s() const { return settle_s + min_length_s + leave_s; }
  std::string json() const;  // for the provenance of a result
};

// The points do not depend on how the frames are divided into blocks. max_scans limits the memory.
// Thread-bound.
class DwellDetector {
 public:
  // `probe_ids` and `probe_range_m` in the order of the frames' probes.
  DwellDetector(DwellOptions options, std::vector<std::string> probe_ids,
                std::vector<double> probe_range_m);

  // Appends the points of complete stops to `out`. A median of three readings removes spikes of one
  // sample from the encoder. Frames without a valid position (place_watch.h) are counted and left
  // out; many consecutive frames without a valid position are a gap.
  void push(const FrameBlock& frames, std::vector<Point>& out);
  // States that the axis was not observed between this time and the next frame. The current dwell
  // ends at this time, and the approach of the next dwell is unknown. Call it before frames after
  // this time are pushed.
  void break_after(std::int64_t time_ns);
  // Ends the data and completes the current dwell.
  void flush(std::vector<Point>& out);

  // Changes the points by means of the whole log so far. Adds flags to the points of a probe that
  // froze or stepped. If a stop with a constant reading was averaged before the resolution of the
  // probe was known, sets the uncertainty of the rounding.
  void mark(std::vector<Point>& points) const;
  // Notices about events in the log that are not visible in the points.
  Notices notices(const std::vector<Point>& points) const;
  const std::vector<DwellEvent>& events() const { return events_; }
  // Frozen probes that were found up to now.
  std::vector<FrozenProbe> frozen_probes() const { return watch_.frozen(); }

  struct Summary {
    std::uint64_t scans = 0;
    double encoder_min_m = 0, encoder_max_m = 0;
    double period_s = 0;         // median of the first intervals
    std::uint64_t gaps = 0;      // number of intervals longer than three periods
    std::uint64_t unplaced = 0;  // frames without a valid position, not in `scans`
    double longest_still_s = 0;  // longest time within the tolerance
    double tolerance_m = 0;      // current value
    // mdof finds each stop of at least this length. In a slow log, the steps of the detection are
    // longer, so this can be more than DwellOptions::shortest_s().
    double needed_s = 0;
    std::size_t brief_points = 0;  // points of shorter stops
    // Stops that became no point because they are too short or creep; only the first
    // kMaxPassedOver.
    struct PassedOver {
      double position_m = 0, length_s = 0;
      std::int64_t begin_ns = 0;
      bool too_short = false;  // false: the axis crept
    };
    std::vector<PassedOver> passed_over;
  };
  static constexpr std::size_t kMaxPassedOver = 10'000;
  const Summary& summary() const { return summary_; }
  // Returns whether a stop crept too far to become a point.
  bool crept() const;
  // The reason why no stop became a point: "the axis stayed within 2 um for at most 0.1 s, …".
  std::string why_no_stop() const;
  bool still() const { return dwelling_; }

 private:
  static constexpr std::size_t kMinScans = 5;  // fewest scans of a dwell, and of a probe in it
  static constexpr int kGapPeriods = 3;
  static constexpr std::size_t kSlotsPerWindow = 4;

  // The time step of the detection: a quarter of window_s, or longer in a slow log.
  struct Slot {
    std::int64_t index = 0;
    std::size_t first_row = 0, rows = 0;  // in buffer_
    std::int64_t begin_ns = 0;
    double min_m = 0, max_m = 0;
    double bend_m = 0;           // sum of |second differences|, a measure of the noise at any speed
    double sharp_m = 0;          // largest |second difference|
    std::uint64_t unplaced = 0;  // frames without a valid position up to this slot
    double middle() const { return 0.5 * (min_m + max_m); }
  };

  void push_rows(const FrameBlock& frames, std::size_t from, std::size_t to,
                 std::vector<Point>& out);
  std::size_t gather_early(const FrameBlock& frames);
  void start(std::vector<Point>& out);
  void push_from(const FrameBlock& frames, std::size_t from, std::vector<Point>& out);
  void open_slot(std::int64_t index);
  void learn_period(const FrameBlock& frames);
  void begin_travelled_range(double position_m);
  void add_rows(std::size_t to);
  void close_slot(std::vector<Point>& out);
  double window_range() const;
  bool window_still() const {
    return slots_.size() == kSlotsPerWindow && window_range() <= summary_.tolerance_m;
  }
  std::int64_t window_ns() const { return static_cast<std::int64_t>(options_.window_s * 1e9); }
  std::int64_t shortest_slot_ns() const {
    return window_ns() / static_cast<std::int64_t>(kSlotsPerWindow);
  }
  bool is_slow() const { return slot_ns_ > shortest_slot_ns(); }
  void pass_hole();
  void examine_window(bool still);
  void find_encoder_jump();
  void note(const DwellEvent& event);
  void take_rest(double length_s) {
    summary_.longest_still_s = std::max(summary_.longest_still_s, length_s);
  }
  // Returns whether the stop has become a point.
  bool keep_or_report(Point point, std::size_t first_row, std::size_t end_row,
                      std::vector<Point>& out);
  double turn_m() const;
  bool continues_stop(double position_m) const;
  void extend_travelled_range(const Slot& slot);
  int direction_to(double position_m) const;
  void begin_dwell();
  void end_dwell(std::vector<Point>& out);
  std::size_t find_rest_end(const Slot& last) const;
  void end_visible_rows(std::vector<Point>& out);
  void pass_break(std::vector<Point>& out);
  Point average(std::size_t from, std::size_t to);
  std::span<const double> own_readings(std::size_t probe, std::size_t from, std::size_t to,
                                       std::size_t& usable_rows, OverRange& over_range);
  void average_probe(std::size_t probe, std::size_t from, std::size_t to, Point& point);
  void drop_rows_before(std::size_t row);  // only if there are kDropRows such rows
  void drop_rows(std::size_t row);
  void drop_cut_rows();

  DwellOptions options_;
  std::vector<std::string> probe_ids_;
  std::vector<double> probe_range_m_;
  ProbeResolution resolution_;
  Summary summary_;

  PlaceWatch places_;
  FrameBlock early_;  // rows that are collected until the period is known
  std::int64_t period_ns_ = 0, slot_ns_ = 0, hole_ns_ = 0, origin_ns_ = 0, last_ns_ = 0;
  std::array<double, 2> encoder_before_{};  // the last two positions, for the median of three
  FrameBlock buffer_;                       // rows of slots_ and of the current dwell
  std::deque<Slot> slots_;                  // the last window, newest at the back
  std::size_t row_ = 0;                     // first row of buffer_ that belongs to no slot yet
  Slot open_;
  bool slot_open_ = false;
  NoiseFloor encoder_noise_;
  MotionTrace motion_;
  std::deque<std::int64_t> breaks_;  // times of break_after() that the frames have not reached

  bool dwelling_ = false, truncated_ = false;
  std::int64_t still_since_ns_ = 0;
  std::uint64_t unplaced_before_ = 0;  // frames without a valid position before the dwell
  std::size_t cut_row_ = 0;            // first row of the current dwell that is not averaged
  std::int64_t left_ns_ = 0;           // time and position of the end of the last stop; 0: none
  double left_m_ = 0;
  struct Way {
    double min_m = 0, max_m = 0;
  };
  // Whether the axis was observed without interruption since the last point, or since the
  // beginning.
  bool travel_observed_ = true;
  // Range of positions since the last point (or the beginning): up to now, and up to the start of
  // the last stop.
  Way travelled_range_, range_to_stop_;
  Way range_since_stop_;             // range of positions since the axis left the last stop
  double sharp_since_stop_m_ = 0;    // largest Slot::sharp_m since then
  bool last_stop_is_point_ = false;  // the last stop became a point
  int direction_ = 0;                // direction of approach of the current stop
  std::vector<double> scratch_, finite_;

  std::vector<DwellEvent> events_;
  ProbeWatch watch_;
  SlowStretch slow_;
  EncoderJump last_jump_;
  double jumped_m_ = 0;              // sum of the encoder's jumps
  std::int64_t jumps_until_ns_ = 0;  // jumps were searched for up to this time
};

}  // namespace mdof::algo
