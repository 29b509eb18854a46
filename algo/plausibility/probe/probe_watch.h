// Probes that died or shifted: a constant value, or a step without another cause.
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
  std::int64_t begin_ns = 0, end_ns = INT64_MAX;  // INT64_MAX: to the end
  double value_m = 0;
};

struct SteppedProbe {
  std::size_t probe = 0;
  std::int64_t time_ns = 0;
  double size_m = 0;
};

// A probe is frozen if its reading stays the same to the last bit
//  - for 128 scans and eight times longer than ever before, if its noise was larger than its
//    resolution in every stop before (at least three): rounding cannot hide such noise;
//  - over four fifths of the travel, if it changed by four times its resolution before: rounding
//  can
//    hide the noise, but not the errors of the whole axis;
//  - from the first scan to the last, if half of the others have noise larger than their
//    resolution.
// A probe steps if its reading changes from one scan to the next by more than 12 times its noise in
// the stops, four times its resolution and eight times its changes around, and stays there, while
// no other probe changes by a quarter of this and the motion of the axis does not change. A stream:
// the result does not depend on how the data are divided; memory grows with the stops.
class ProbeWatch {
 public:
  explicit ProbeWatch(std::size_t probes) : probes_(probes) {}

  // Rows of a slot, with the rows before and after it.
  struct Rows {
    const FrameBlock& frames;
    std::size_t begin, first, last,
        end;  // begin <= first < last <= end; the slot is first ... last
  };
  // Takes the newest slot: its constant readings, and the travel of the axis in it.
  void take_newest(const FrameBlock& frames, std::size_t first, std::size_t last, double low_m,
                   double high_m);
  // Looks for steps in a slot that has others before and after it.
  void look_for_steps(const Rows& rows);
  void take_stop(std::size_t probe, const RobustMean& mean, double resolution_m);

  // Results so far.
  std::vector<FrozenProbe> frozen() const;
  std::vector<SteppedProbe> steps() const;
  // Readings of a frozen probe become NaN with the flag "frozen:C". Those after a step get
  // "step:C".
  void mark(std::vector<Point>& points, const std::vector<std::string>& ids) const;

  // At most one probe ever changed its reading while the axis moved: a measuring chain without a
  // signal, or an exact recording of an axis without errors. The readings are kept.
  bool is_dead() const;

 private:
  struct Probe {
    bool begun = false, changed = false, is_frozen = false;
    double held_m = 0, low_m = 0, high_m = 0;  // low, high: of all readings before held_m
    std::int64_t since_ns = 0;
    std::size_t rows = 0, longest = 0;       // with the same reading
    double axis_low_m = 0, axis_high_m = 0;  // during this time
    double resolution_m = 0;
    std::size_t changes = 0, stops = 0, noisy_stops = 0;
    std::vector<double> sd_m;  // for each stop
    std::vector<FrozenProbe> frozen;
    std::vector<SteppedProbe> steps;  // candidates
  };

  bool never_changed(const Probe& probe) const;
  void hold(Probe& probe, std::size_t index, double low_m, double high_m);
  void release(Probe& probe, double reading_m, std::int64_t time_ns);
  bool noise_says_frozen(const Probe& probe) const;
  bool travel_says_frozen(const Probe& probe) const;

  std::vector<Probe> probes_;
  bool moved_ = false;
  double axis_low_m_ = 0, axis_high_m_ = 0;
};

// A notice for each of them, with its time after `start_ns`.
Notices probe_notices(const ProbeWatch& watch, const std::vector<std::string>& ids,
                      std::int64_t start_ns);

}  // namespace mdof::algo
