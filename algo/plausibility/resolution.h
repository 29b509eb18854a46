// The step in which a channel's readings come.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "schema/sample.h"

namespace mdof::algo {

// Found from the readings themselves, as no rig states it: the smallest step that comes again and
// again between a reading that stayed and one that stays. That is how readings look whose step is
// larger than their noise; where noise carries them over several steps at once nothing is found,
// and nothing is needed: the mean then resolves less than a step. Exact numbers of a simulation
// have no step, and none is found. The same however the data are cut; memory is fixed.
class Resolution {
 public:
  // Neighbouring readings in the order of time.
  void add(std::span<const double> readings);
  double step() const { return step_; }  // 0: none known

 private:
  static constexpr std::size_t kKept = 64;
  void keep(double step);

  std::array<double, kKept> smallest_{};  // steps seen, ascending
  std::size_t kept_ = 0;
  double step_ = 0;
};

// The same of each probe of frames, up to the first row that repeats a probe's reading: from there
// on the probe is slower than the encoder, and values between its samples hide its step.
class ProbeResolution {
 public:
  explicit ProbeResolution(std::size_t probes) : found_(probes) {}
  // Rows `first` to `last` - 1, behind those that it has.
  void add(const FrameBlock& frames, std::size_t first, std::size_t last);
  double step_m(std::size_t probe) const { return found_[probe].resolution.step(); }

 private:
  struct Found {
    Resolution resolution;
    bool is_slow = false;
  };
  std::vector<Found> found_;
};

// Standard uncertainty of a mean `u` of readings with this `sd`, rounded to multiples of `step`.
// Noise of half a step or more dithers: the rounding averages out. Less leaves a rectangular
// distribution one step wide (GUM F.2.2.1), so that what never changes has step/√12.
double with_resolution(double u, double sd, double step);

}  // namespace mdof::algo
