// Machine and target by least squares over all set-ups:
//   error_k(x) = machine(x) + sense · sign_k · height(c_k(x)) + a_k + b_k x
// k: set-up; x: position; c_k: place on the target (set_up.h); sense: +1 where the target moves, -1
// where the fixture does; a_k, b_k: how the target was clamped, which is never known. Reversal is
// the case of two set-ups with signs +1 and -1: machine = (e1 + e2)/2, height = (e1 - e2)/2, each
// less a line.
#pragma once

#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"
#include "schema/separation/separation.h"

namespace mdof::algo {

struct SeparationRequest {
  ReadAt at;
  std::vector<SetUp> set_ups;  // the first: without turn and shift
  double match_m = 20e-6;      // places that lie so close are one
  bool u_is_noise = false;  // u of the readings has their noise and repeatability only, as of runs
};

// What the set-ups see of both, with the covariance of that alone: u of the readings, and what is
// declared of each set-up (of a quantity that several share, with its signs). A tilt of the target
// between the set-ups is b_k, and not in u. Shapes that they do not see are
// the parts of the null space of these equations, named in `unseen`. Errors: fewer than two set-ups
// or three readings in one; numbers that are none; set-ups that share no place of the machine or of
// the target; more readings than fit.
Result<Separation> separate(const SeparationRequest& request);

}  // namespace mdof::algo
