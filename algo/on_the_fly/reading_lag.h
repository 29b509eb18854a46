// Finds undeclared delays of probes from the difference between forward and reverse passes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "algo/on_the_fly/pass_bins.h"

namespace mdof::algo {

struct ReadingLag {
  // Delay of the probe's readings relative to the encoder, in addition to the declared delay, which
  // is already removed. NaN: the delay cannot be determined.
  double delay_s = 0, u_delay_s = 0;
  double speed_m_s = 0;        // mean speed of the passes
  double largest_slope_1 = 0;  // largest |slope| of the readings over the position
  double effect_m = 0;         // largest change of a reading due to the delay, in one direction
  bool significant = false;    // the delay exceeds five times its u, and the effect exceeds 2 nm
};

// Returns the delay of each probe. With a delay tau, a reading belongs to the position that the
// axis passed the distance speed * tau before. So the difference forward minus reverse is
//   -slope * (sum of the speeds) * tau.
//
// tau is fitted to the targets that were passed in both directions. A constant and a line over the
// position are fitted, too; they describe the difference of the axis itself between its directions.
// u is from the residuals of the fit; u is increased if the residuals of neighbouring targets are
// correlated. The delay is NaN if fewer than twelve targets were passed in both directions, or if
// the slope of a reading hardly changes along the travel: the effect of a delay then cannot be
// distinguished from the difference of the axis itself. At one speed, a backlash of the encoder of
// 2 * speed * delay_s has the same effect as the delay.
std::vector<ReadingLag> reading_lags(const std::vector<PassBins>& passes, std::size_t probes);

}  // namespace mdof::algo
