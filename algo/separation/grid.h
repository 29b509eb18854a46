// The places of the machine and of the target at which the set-ups have readings.
#pragma once

#include <cstddef>
#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"

namespace mdof::algo {

struct Grid {
  std::vector<double> position_m;  // positions of the encoder, ascending
  std::vector<double> place_m;     // places on the target, ascending
  // Step of positions and places, if a set-up is shifted or turned end for end; otherwise 0.
  double step_m = 0;
  // Index in position_m and index in place_m of each reading; first all readings of the first
  // set-up, then those of the next set-up, and so on.
  std::vector<std::size_t> at_position, at_place;
};

// Positions within `match_m` of each other are one position. If a set-up is shifted or turned end
// for end, the positions must be equally spaced, and the shift must be a multiple of the step.
// Otherwise the probe does not measure the same places of the target again. Errors (bad_input): a
// position or shift deviates by more than match_m; fewer than three positions.
Result<Grid> grid_of(const ReadAt& at, const std::vector<SetUp>& set_ups, double match_m);

}  // namespace mdof::algo
