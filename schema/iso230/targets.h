// Which positions are one target of a series.
#pragma once

#include <cstddef>
#include <vector>

namespace mdof {

// Written positions differ by rounding: those within this are one target.
inline constexpr double kSameTarget_m = 1e-7;

// The different positions, ascending; of those that are one target the first.
std::vector<double> distinct_targets(std::vector<double> positions_m);
// The nearest of them.
std::size_t target_at(const std::vector<double>& targets_m, double position_m);

}  // namespace mdof
