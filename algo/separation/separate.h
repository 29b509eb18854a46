// Separates machine and target by least squares over all set-ups:
//   error_k(x) = machine(x) + sense · sign_k · height(c_k(x)) + a_k + b_k x
// k: set-up; x: position; c_k: place on the target (set_up.h); sense: +1 if the target moves, -1 if
// the fixture moves; a_k, b_k: clamping of the target, always unknown. Reversal is the case of two
// set-ups with signs +1 and -1: machine = (e1 + e2)/2, height = (e1 - e2)/2, each minus a line.
#pragma once

#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"
#include "schema/separation/separation.h"

namespace mdof::algo {

struct SeparationRequest {
  ReadAt at;
  std::vector<SetUp> set_ups;  // the first: without turn and shift
  double match_m = 20e-6;      // places within this distance are one
  bool u_is_noise = false;  // u of the readings has only their noise and repeatability, as for runs
};

// The parts of machine and target that the set-ups determine, with the covariance of these parts.
// It includes u of the readings and the declared uncertainties of each set-up; a quantity that
// several set-ups share counts with its signs. A tilt of the target between the set-ups is b_k, and
// not in u. Shapes that the set-ups do not determine are the null space of the equations, named in
// `unseen`. Errors: fewer than two set-ups or three readings in one; numbers that are not finite;
// set-ups that share no place of the machine or of the target; too many readings.
Result<Separation> separate(const SeparationRequest& request);

}  // namespace mdof::algo
