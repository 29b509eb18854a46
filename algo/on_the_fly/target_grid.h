// Targets of a run that is measured in motion, and the stretch of travel, the bin, about each.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "schema/base/result.h"

namespace mdof::algo {

struct OnTheFlyOptions {
  // From target to target: at from_mm and on from there, or else at whole multiples. 0: the targets
  // are those of the run (SequenceOptions::targets_m).
  double interval_mm = 1;
  double bin_mm = 0;                     // length of a bin; 0: from target to target, at most 1 mm
  std::optional<double> from_mm, to_mm;  // none beyond; without: as far as the axis goes steadily

  std::string json() const;  // for the provenance
};

// Errors (usage), naming the key: no interval and no targets, a range that is none, bins that
// overlap or are too small for any encoder, more targets than 10,000.
Status check_on_the_fly(const OnTheFlyOptions& options, const std::vector<double>& targets_m);

class TargetGrid {
 public:
  // Only what check_on_the_fly() accepts; `targets_m` ascending, used where there is no interval.
  TargetGrid(const OnTheFlyOptions& options, std::vector<double> targets_m);

  struct Target {
    std::int64_t place = 0;  // ascends with the position
    double position_m = 0;
  };
  double bin_m() const { return bin_m_; }
  // Targets whose bins lie between these positions as a whole, ascending; none where they would be
  // more than `most`.
  std::vector<Target> between(double low_m, double high_m, std::size_t most) const;
  // All targets where they are known beforehand (a list, or both ends); else empty.
  std::vector<Target> known() const;

 private:
  Target at(std::int64_t place) const;

  OnTheFlyOptions options_;
  std::vector<double> targets_m_;
  double bin_m_ = 0;
};

}  // namespace mdof::algo
