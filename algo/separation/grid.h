// The places of machine and target that the readings of all set-ups share.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"

namespace mdof::algo {

struct Grid {
  std::vector<double> position_m;  // of the encoder, ascending
  std::vector<double> place_m;     // on the target, ascending
  double step_m = 0;  // of both, where a set-up is shifted or turned end for end; 0: any steps
  // Of each reading, set-up after set-up: where in those two.
  std::vector<std::size_t> at_position, at_place;
};

// Positions within `match_m` of each other are one. Where a set-up is shifted or turned end for
// end, they are taken to be equally spaced, and the shift to be whole steps: only so does a place
// on the target come back under the probe. Errors (bad input): they are not, by more than match_m.
Result<Grid> grid_of(const ReadAt& at, const std::vector<SetUp>& set_ups, double match_m);

}  // namespace mdof::algo
