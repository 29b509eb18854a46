// Finds the targets of a series of positions.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof {

// Positions within this distance belong to one target, because positions in files are rounded.
inline constexpr double kSameTarget_m = 1e-7;

// Returns the targets in ascending order. The position of a target is the smallest of its
// positions.
std::vector<double> distinct_targets(std::vector<double> positions_m);
// Returns the index of the nearest target.
std::size_t target_at(const std::vector<double>& targets_m, double position_m);

}  // namespace mdof
