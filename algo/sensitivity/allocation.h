// Finds the largest size of a tolerance for which P(|output| <= limit) >= probability.
//
// The same trials are evaluated with scaled values of the quantity. With increasing scale, the
// share of trials within the limit decreases. Bisection finds the scale at which this share is
// equal to the probability. The sampling uncertainty is the interval between the two scales at
// which the number of trials within the limit is n p ± 1.96 √(n p (1 - p)). These order statistics
// enclose the quantile with 95 % confidence.
#pragma once

#include <cstddef>
#include <functional>

#include "algo/sensitivity/plan/experiment.h"
#include "schema/base/result.h"
#include "schema/study/plan.h"
#include "schema/study/study.h"

namespace mdof::algo {

// Calls task(0) ... task(count - 1) in any order, in any threads. Returns when all tasks are
// complete.
using ForEach =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& task)>;
void one_after_the_other(std::size_t count, const std::function<void(std::size_t)>& task);

// Calculates the largest size of each tolerance, with the other tolerances as planned. Sizes are
// defined as in ScalableExperiment::sizes(), in the unit of the quantity.
//   0         the requirement is not met even without this tolerance
//   infinite  the requirement is met even at 2^20 times the planned size
// The frontier shows the first two tolerances together: the largest size of the second one for
// eight sizes of the first one, without sampling uncertainty (low and high are NaN). The frontier
// is empty if the largest size of the first tolerance is 0 or infinite. Errors: an output or a
// tolerance that the experiment does not have.
Result<Allocation> allocate(const ScalableExperiment& experiment, const PlannedAllocation& planned,
                            const ForEach& for_each = one_after_the_other);

// The largest common factor for the quantities `which` that meets the requirement, with the other
// quantities as planned. 0 and infinite as above. Ignores `planned.tolerances`.
Result<double> largest_factor(const ScalableExperiment& experiment,
                              const PlannedAllocation& planned,
                              const std::vector<std::size_t>& which,
                              const ForEach& for_each = one_after_the_other);

}  // namespace mdof::algo
