// Undeclared delays of probes, from the difference between forward and reverse passes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algo/on_the_fly/pass_bins.h"

namespace mdof::algo {

struct ReadingLag {
  // Delay of the readings relative to the encoder, in addition to the delay that is already
  // removed; NaN: it cannot be determined.
  double delay_s = 0, u_delay_s = 0;
  double speed_m_s = 0;      // mean of the passes
  double steepest_1 = 0;     // slope of the readings over the position; it multiplies a delay
  double effect_m = 0;       // largest change of a reading by the delay, one direction
  bool significant = false;  // above five times u and above 2 nm
};

// For each probe. A reading with a delay tau is from the position speed * tau before, so forward
// minus reverse is -slope * (sum of the speeds) * tau. This is fitted over the targets that were
// passed in both directions, together with a constant and a line over the position, which describe
// the difference of an axis between its directions. u is from the residuals of the fit, widened if
// they are correlated from target to target. Nothing is stated if the slope of a reading hardly
// changes along the travel, because a delay then looks like the axis' own difference. The backlash
// of an encoder also looks like delay_s at one speed: speed * delay_s in each direction.
std::vector<ReadingLag> reading_lags(const std::vector<PassBins>& passes, std::size_t probes);

}  // namespace mdof::algo
