// Targets of a run that is measured in motion, and the bin (range of travel) of each target.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

struct OnTheFlyOptions {
  // Distance between targets: from from_mm on, or else at multiples of the interval. 0: the targets
  // are those of the run (SequenceOptions::targets_m).
  double interval_mm = 1;
  double bin_mm = 0;  // length of a bin; 0: target to target, at most 1 mm
  // Range of the targets; empty: up to where the axis moves at a steady speed.
  std::optional<double> from_mm, to_mm;

  std::string json() const;  // for the provenance
};

// Errors (usage), which name the key: neither interval nor targets; an empty range; bins that
// overlap or are too small for any encoder; more than 10,000 targets.
Status check_on_the_fly(const OnTheFlyOptions& options, const std::vector<double>& targets_m);

class TargetGrid {
 public:
  // `options` must pass check_on_the_fly(). `targets_m` is ascending and used if there is no
  // interval.
  TargetGrid(const OnTheFlyOptions& options, std::vector<double> targets_m);

  struct Target {
    std::int64_t place = 0;  // ascends with the position
    double position_m = 0;
  };
  double bin_m() const { return bin_m_; }
  // Targets whose whole bins are between these positions, ascending; empty if there are more than
  // `most`.
  std::vector<Target> between(double low_m, double high_m, std::size_t most) const;
  // All targets if they are known beforehand (a list, or both ends); otherwise empty.
  std::vector<Target> known() const;

 private:
  Target at(std::int64_t place) const;

  OnTheFlyOptions options_;
  std::vector<double> targets_m_;
  double bin_m_ = 0;
};

}  // namespace mdof::algo
