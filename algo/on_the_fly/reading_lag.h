// Delays of probes that nobody has declared, from what forward and reverse passes differ by.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algo/on_the_fly/pass_bins.h"

namespace mdof::algo {

struct ReadingLag {
  // By how much the readings come later than the encoder, beside what is taken out already; NaN:
  // it cannot be determined.
  double delay_s = 0, u_delay_s = 0;
  double speed_m_s = 0;      // mean of the passes
  double steepest_1 = 0;     // of the readings over the position: what a delay is multiplied by
  double effect_m = 0;       // the most that the delay moves a reading, one way
  bool significant = false;  // over five times u, and over two nm
};

// Of each probe. A reading that comes late by tau is of the place speed * tau back, so that forward
// minus reverse is -slope * (sum of the speeds) * tau. This is fitted over the targets that were
// passed both ways beside a constant and a line over the position, which are how an axis differs by
// its direction. u: of the fit's residuals, widened where these are not independent from target to
// target. Where a reading's slope hardly changes along the travel nothing is stated: a delay then
// looks like the axis' own difference. What the encoder loses when the axis turns (backlash) looks
// like delay_s as well, at one speed: speed * delay_s each way.
std::vector<ReadingLag> reading_lags(const std::vector<PassBins>& passes, std::size_t probes);

}  // namespace mdof::algo
