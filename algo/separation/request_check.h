// Checks of a request for a separation.
#pragma once

#include <vector>

#include "algo/separation/grid.h"
#include "algo/separation/separate.h"
#include "schema/base/result.h"

namespace mdof::algo {

// Errors: fewer than two set-ups; identical set-ups; fewer than three readings in a set-up; too
// many readings; numbers that are not finite or above 1000 km; a negative standard uncertainty.
Status check_request(const SeparationRequest& request);

// Error: no two set-ups measure the same place of the machine, or no two set-ups measure the same
// place of the target.
Status check_shared(const Grid& grid, const std::vector<SetUp>& set_ups);

}  // namespace mdof::algo
