// The places of machine and target that the readings of all set-ups have in common.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"

namespace mdof::algo {

struct Grid {
  std::vector<double> position_m;  // positions of the encoder, ascending
  std::vector<double> place_m;     // places on the target, ascending
  double step_m = 0;  // step of both, if a set-up is shifted or turned end for end; 0: any steps
  // For each reading, set-up after set-up: its indices in position_m and place_m.
  std::vector<std::size_t> at_position, at_place;
};

// Positions within `match_m` of each other are one position. If a set-up is shifted or turned end
// for end, the positions must be equally spaced and the shift must be a multiple of the step: only
// then does the probe measure the same places of the target again. Errors (bad input): a deviation
// of more than match_m from this.
Result<Grid> grid_of(const ReadAt& at, const std::vector<SetUp>& set_ups, double match_m);

}  // namespace mdof::algo
