// What a separation cannot be made of.
#pragma once

#include <vector>

#include "algo/separation/grid.h"
#include "algo/separation/separate.h"
#include "schema/base/result.h"

namespace mdof::algo {

// Fewer than two set-ups, or all alike; fewer than three readings in one, or too many; numbers that
// are none.
Status check_request(const SeparationRequest& request);

// Set-ups that share no place of the machine, or none of the target, say nothing of each other.
Status check_shared(const Grid& grid, const std::vector<SetUp>& set_ups);

}  // namespace mdof::algo
