// Checks of a request for a separation.
#pragma once

#include <vector>

#include "algo/separation/grid.h"
#include "algo/separation/separate.h"
#include "schema/base/result.h"

namespace mdof::algo {

// Errors: fewer than two set-ups, or identical set-ups; fewer than three readings in one, or too
// many readings; numbers that are not finite or above 1000 km; a negative standard uncertainty.
Status check_request(const SeparationRequest& request);

// Error: the set-ups share no place of the machine, or no place of the target.
Status check_shared(const Grid& grid, const std::vector<SetUp>& set_ups);

}  // namespace mdof::algo
