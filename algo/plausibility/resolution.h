// The resolution (step) of a channel's readings.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {

// The resolution is determined from the readings, because no rig states it. It is the smallest step
// that occurs repeatedly between two values. Both values must occur in at least two consecutive
// readings. Readings have such steps if their resolution is larger than their noise. If the noise
// is several steps, no step is found; the step is then not needed, because the mean has a
// much smaller resolution. Exact numbers of a simulation have no step. The result does not depend
// on how the data are divided into blocks; memory is fixed.
class Resolution {
 public:
  // Takes consecutive readings in the order of time.
  void add(std::span<const double> readings);
  double step() const { return step_; }  // 0: unknown

 private:
  static constexpr std::size_t kKept = 64;
  void keep(double step);

  std::array<double, kKept> smallest_{};  // smallest steps so far, ascending
  std::size_t kept_ = 0;
  double step_ = 0;
};

// The resolution of each probe of frames. It is determined up to the first row without a new sample
// of the probe. Such a probe is slower than the encoder, and the values interpolated between its
// samples do not show its step.
class ProbeResolution {
 public:
  explicit ProbeResolution(std::size_t probes) : found_(probes) {}
  // Takes the rows `first` to `last` - 1, which follow the rows of earlier calls.
  void add(const FrameBlock& frames, std::size_t first, std::size_t last);
  double step_m(std::size_t probe) const { return found_[probe].resolution.step(); }

 private:
  struct Found {
    Resolution resolution;
    bool is_slow = false;
  };
  std::vector<Found> found_;
};

// Returns the standard uncertainty of a mean including the rounding of the readings to multiples of
// `step`. `u`: uncertainty of the mean without rounding; `sd`: standard deviation of the readings.
// If the noise is at least half a step, the mean of many readings has no rounding error. For
// smaller noise the error has a rectangular distribution with the width of one step (GUM F.2.2.1),
// so a constant reading has u = step/√12.
double with_resolution(double u, double sd, double step);

}  // namespace mdof::algo
