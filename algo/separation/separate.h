// Separates the errors of the machine from the heights of the target, by least squares over all
// set-ups:
//   error_k(x) = machine(x) + sense · sign_k · height(c_k(x)) + a_k + b_k x
//   k         number of the set-up
//   x         position
//   c_k       place on the target (set_up.h)
//   sign_k    height_sign of the set-up (set_up.h)
//   sense     +1 if the target moves, -1 if the fixture moves
//   a_k, b_k  offset and tilt of the target in its clamping, always unknown
// Reversal is the special case of two set-ups with the signs +1 and -1 and the errors e1 and e2:
// machine = (e1 + e2)/2 and height = sense · (e1 - e2)/2, each except for a straight line.
#pragma once

#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"
#include "schema/separation/separation.h"

namespace mdof::algo {

struct SeparationRequest {
  ReadAt at;
  std::vector<SetUp> set_ups;  // the first set-up has no turn and no shift
  double match_m = 20e-6;      // places within this distance are the same place
  bool u_is_noise = false;  // u of the readings contains only noise and repeatability, as in runs
};

// Returns the parts of machine(x) and height(c) that the set-ups determine, with their u. u
// includes u of the readings and the declared uncertainties of each set-up. A quantity that is
// common to several set-ups is one quantity, and its effects are added with their signs. u does not
// include a tilt of the target between the set-ups, because b_k describes it. `unseen` describes
// the shapes that the set-ups do not determine (null space of the equations). Readings that
// shared_readings() leaves out are not used. Errors: as check_request(), grid_of(), check_shared()
// and shared_readings(); too many unknowns.
Result<Separation> separate(const SeparationRequest& given);

}  // namespace mdof::algo
