// Which positions belong to one target of a series.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof {

// Written positions are rounded; positions within this distance belong to one target.
inline constexpr double kSameTarget_m = 1e-7;

// The different positions, ascending; the first position of each target.
std::vector<double> distinct_targets(std::vector<double> positions_m);
// Index of the nearest target.
std::size_t target_at(const std::vector<double>& targets_m, double position_m);

}  // namespace mdof
