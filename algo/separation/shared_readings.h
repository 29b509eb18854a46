// The readings of a separation that can determine machine and target.
#pragma once

#include <vector>

#include "algo/separation/grid.h"
#include "algo/separation/set_up.h"
#include "schema/base/result.h"
#include "schema/notice/notice.h"

namespace mdof::algo {

// For each position (or place) of `at`, see Grid: whether more than one set-up measures it.
std::vector<bool> are_shared(const std::vector<std::size_t>& at, const std::vector<SetUp>& set_ups);

struct SharedReadings {
  std::vector<SetUp> set_ups;
  Grid grid;
  Notices notices;  // the readings that are left out
};

// Leaves out each reading whose position and whose place no other set-up measures. Such a reading
// determines only the sum of machine and target at this position. Errors (bad_input): a set-up
// without remaining readings; fewer than three remaining positions.
Result<SharedReadings> shared_readings(std::vector<SetUp> set_ups, Grid grid);

}  // namespace mdof::algo
