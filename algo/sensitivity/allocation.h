// How large may a tolerance be, so that P(|output| <= limit) >= probability?
//
// The same trials are evaluated with the quantity's values scaled; the scale at which the share of
// trials within the limit falls to the probability is found by bisection. As the trials stay the
// same, the share falls in steps but without noise. The sampling uncertainty: the scales at which
// the count of trials within is n p ± 1.96 √(n p (1 - p)), the order statistics that enclose the
// quantile with 95 % confidence.
#pragma once

#include <cstddef>
#include <functional>

#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Calls task(0) ... task(count - 1) in any order, on any threads, and returns when all are done.
using ForEach =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;
void one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& task);

// Value 0: the limit is not kept even without this tolerance. Infinite: it is kept at 2^20 times
// the planned size, so this tolerance does not matter. Values have the unit of the quantity and the
// meaning of ScalableExperiment::sizes(). The frontier has the first two tolerances, others as
// planned: for eight values of the first the largest of the second, without sampling uncertainty
// (low, high NaN); empty where the first alone is 0 or infinite.
// Errors: output or tolerance that the experiment has not.
Result<Allocation> allocate(const ScalableExperiment& experiment, const PlannedAllocation& planned,
                            const ForEach& for_each = one_after_the_other);

// The largest factor on these quantities, the others as planned, with which the limit is kept; 0
// and infinite as above. `planned.tolerances` is not read.
Result<double> largest_factor(const ScalableExperiment& experiment,
                              const PlannedAllocation& planned,
                              const std::vector<std::size_t>& which,
                              const ForEach& for_each = one_after_the_other);

}  // namespace mdof::algo
