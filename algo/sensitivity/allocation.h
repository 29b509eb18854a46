// Finds how large a tolerance may be, so that P(|output| <= limit) >= probability.
//
// The same trials are evaluated with scaled values of the quantity. Bisection finds the scale at
// which the share of trials within the limit falls to the probability. Because the trials stay the
// same, the share falls in steps but without noise. The sampling uncertainty is given by the scales
// at which the number of trials within the limit is n p ± 1.96 √(n p (1 - p)): these order
// statistics enclose the quantile with 95 % confidence.
#pragma once

#include <cstddef>
#include <functional>

#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Calls task(0) ... task(count - 1) in any order, on any threads; returns after all of them.
using ForEach =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;
void one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& task);

// Value 0: the limit is not kept even without this tolerance. Infinite: the limit is kept at 2^20
// times the planned size, so this tolerance does not matter. Values have the unit of the quantity
// and the meaning of ScalableExperiment::sizes(). The frontier varies the first two tolerances and
// leaves the others as planned: for eight values of the first it has the largest second, without
// sampling uncertainty (low, high NaN). It is empty if the first alone is 0 or infinite. Errors: an
// output or tolerance that the experiment does not have.
Result<Allocation> allocate(const ScalableExperiment& experiment, const PlannedAllocation& planned,
                            const ForEach& for_each = one_after_the_other);

// The largest common factor of these quantities with which the limit is kept, the others as
// planned; 0 and infinite as above. Ignores `planned.tolerances`.
Result<double> largest_factor(const ScalableExperiment& experiment,
                              const PlannedAllocation& planned,
                              const std::vector<std::size_t>& which,
                              const ForEach& for_each = one_after_the_other);

}  // namespace mdof::algo
