// Targets of a run that is measured in motion, and the bin (range of travel) of each target.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

struct OnTheFlyOptions {
  // Distance between targets. The first target is at from_mm; without from_mm the targets are at
  // multiples of the interval. 0: uses the targets of the run (SequenceOptions::targets_m).
  double interval_mm = 1;
  double bin_mm = 0;  // length of a bin; 0: the distance between targets, at most 1 mm
  // Range of the targets; empty: the range in which the axis moves at a steady speed.
  std::optional<double> from_mm, to_mm;

  std::string json() const;  // for the provenance of a run
};

// Errors (usage), which state the key: neither interval nor targets; an empty range; bins that
// overlap or that are too small for any encoder; more than 10,000 targets.
Status check_on_the_fly(const OnTheFlyOptions& options, const std::vector<double>& targets_m);

class TargetGrid {
 public:
  // `options` must pass check_on_the_fly(). `targets_m` is ascending; it is used only if the
  // interval is 0.
  TargetGrid(const OnTheFlyOptions& options, std::vector<double> targets_m);

  struct Target {
    std::int64_t place = 0;  // number of the target, which increases with the position
    double position_m = 0;
  };
  double bin_m() const { return bin_m_; }
  // Returns the targets whose bins are completely between these positions, in ascending order;
  // empty if there are more than `most` targets.
  std::vector<Target> between(double low_m, double high_m, std::size_t most) const;
  // Returns all targets if the options contain a list or both ends of the range; otherwise empty.
  std::vector<Target> known() const;

 private:
  Target at(std::int64_t place) const;

  OnTheFlyOptions options_;
  std::vector<double> targets_m_;
  double bin_m_ = 0;
};

}  // namespace mdof::algo
