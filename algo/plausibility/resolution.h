// The resolution (step) of a channel's readings.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {

// Determined from the readings, because no rig states it: the smallest step that occurs repeatedly
// between two values that both last for at least two readings. Readings have such steps if their
// resolution is larger than their noise. If noise moves them by several steps at once, no step is
// found, and none is needed, because the mean then resolves less than a step. Exact numbers of a
// simulation have no step. The result does not depend on how the data are divided; memory is fixed.
class Resolution {
 public:
  // Takes consecutive readings in the order of time.
  void add(std::span<const double> readings);
  double step() const { return step_; }  // 0: unknown

 private:
  static constexpr std::size_t kKept = 64;
  void keep(double step);

  std::array<double, kKept> smallest_{};  // steps seen, ascending
  std::size_t kept_ = 0;
  double step_ = 0;
};

// The resolution of each probe of frames, up to the first row that repeats a probe's reading. After
// that the probe is slower than the encoder, and values between its samples hide its step.
class ProbeResolution {
 public:
  explicit ProbeResolution(std::size_t probes) : found_(probes) {}
  // Rows `first` to `last` - 1, after the rows of earlier calls.
  void add(const FrameBlock& frames, std::size_t first, std::size_t last);
  double step_m(std::size_t probe) const { return found_[probe].resolution.step(); }

 private:
  struct Found {
    Resolution resolution;
    bool is_slow = false;
  };
  std::vector<Found> found_;
};

// Standard uncertainty of a mean with uncertainty `u` of readings with this `sd`, rounded to
// multiples of `step`. Noise of at least half a step dithers, so rounding averages out. Less noise
// leaves a rectangular distribution one step wide (GUM F.2.2.1), so a constant reading has
// step/√12.
double with_resolution(double u, double sd, double step);

}  // namespace mdof::algo
