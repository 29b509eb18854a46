// Finds probes that froze (constant reading) or stepped (a step of the reading without another
// cause).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "algo/points/robust_mean.h"
#include "schema/notice/notice.h"
#include "schema/point.h"
#include "schema/sample.h"

namespace mdof::algo {

struct FrozenProbe {
  std::size_t probe = 0;
  std::int64_t begin_ns = 0, end_ns = INT64_MAX;  // INT64_MAX: until the end of the log
  double value_m = 0;
  // The constant reading is the limit of the amplifier: the probe later left this value, and no
  // reading of the log is beyond this value.
  bool at_limit = false;
};

struct SteppedProbe {
  std::size_t probe = 0;
  std::int64_t time_ns = 0;
  double size_m = 0;
};

// A probe is frozen if its reading stays the same to the last bit in one of these cases:
// - for 128 scans and eight times longer than ever before, if its noise was larger than its
//   resolution in every stop before (at least three), because rounding cannot hide such noise;
// - over four fifths of the travel, if it changed by four times its resolution before, because
//   rounding can hide the noise, but not the errors of the whole axis;
// - from the first scan to the last, if at least half of the other probes have noise larger than
//   their resolution.
//
// A probe has stepped if all these conditions are fulfilled:
// - From one scan to the next, its reading changes by more than 12 times its noise in the stops,
//   more than four times its resolution, and more than eight times its other changes near this
//   time.
// - The reading stays at its new value.
// - No other probe changes by a quarter of the step.
// - The motion of the axis does not change.
//
// The result does not depend on how the data are divided into blocks. The memory grows with the
// number of stops.
class ProbeWatch {
 public:
  explicit ProbeWatch(std::size_t probes) : probes_(probes) {}

  // The rows of a slot (first ... last - 1), with rows before and after the slot.
  struct Rows {
    const FrameBlock& frames;
    std::size_t begin, first, last,
        end;  // begin <= first < last <= end
  };
  // Examines the newest slot for constant readings. `low_m` ... `high_m`: range of the axis in this
  // slot.
  void take_newest(const FrameBlock& frames, std::size_t first, std::size_t last, double low_m,
                   double high_m);
  // Looks for steps in a slot. The rows before and after this slot must be known.
  void look_for_steps(const Rows& rows);
  void take_stop(std::size_t probe, const RobustMean& mean, double resolution_m);

  // Frozen probes and steps that were found up to now.
  std::vector<FrozenProbe> frozen() const;
  std::vector<SteppedProbe> steps() const;
  // For a frozen probe C, the readings become NaN and the points get the flag "frozen:C". After a
  // step, the points get the flag "step:C".
  void mark(std::vector<Point>& points, const std::vector<std::string>& ids) const;

  // Returns whether at most one probe changed its reading although the axis moved. Either the
  // measuring chain had no signal, or the log is an exact recording of an axis without errors. The
  // readings are kept.
  bool is_dead() const;

 private:
  struct Probe {
    bool begun = false, changed = false, is_frozen = false;
    double held_m = 0, low_m = 0, high_m = 0;  // low_m, high_m: range of all readings before held_m
    std::int64_t since_ns = 0;
    std::size_t rows = 0, longest = 0;       // rows with the same reading; most such rows
    double axis_low_m = 0, axis_high_m = 0;  // range of the axis during these rows
    double resolution_m = 0;
    std::size_t changes = 0, stops = 0, noisy_stops = 0;
    std::vector<double> sd_m;  // for each stop
    std::vector<FrozenProbe> frozen;
    std::vector<SteppedProbe> steps;  // candidates for steps
  };

  bool never_changed(const Probe& probe) const;
  static bool is_at_limit(const Probe& probe, double value_m);
  void hold(Probe& probe, std::size_t index, double low_m, double high_m);
  void release(Probe& probe, double reading_m, std::int64_t time_ns);
  bool noise_says_frozen(const Probe& probe) const;
  bool travel_says_frozen(const Probe& probe) const;

  std::vector<Probe> probes_;
  bool moved_ = false;
  double axis_low_m_ = 0, axis_high_m_ = 0;
};

// Returns a notice for each frozen or stepped probe, with the time after `start_ns`.
Notices probe_notices(const ProbeWatch& watch, const std::vector<std::string>& ids,
                      std::int64_t start_ns);

}  // namespace mdof::algo
