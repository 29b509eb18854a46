// How steeply the errors of a run change along its axis.
#pragma once

#include <vector>

#include "schema/run.h"

namespace mdof::algo {

// Of each point the change of the errors, local frame and stated where the run is, by 1 m of the
// target's travel: by the means of the neighbouring targets of its approach. Of an approach with
// targets at one place only those of both count; 0 where this leaves one place, too. Targets that
// are nearer than 2 % of the mean step are one place: what noise does between them is no slope.
std::vector<Errors5> local_slopes(const Run& run);

}  // namespace mdof::algo
