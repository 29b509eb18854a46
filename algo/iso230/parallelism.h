// Parallelism of two motions along one axis (ISO 230-1).
#pragma once

#include "schema/base/result.h"
#include "schema/iso230/parallelism.h"
#include "schema/run.h"

namespace mdof::algo {

struct CommonTravel {
  // The runs with only those points that are within from_m to to_m, or beyond by less than a tenth
  // of the interval of the targets.
  Run a, b;
  double from_m = 0, to_m = 0;  // travel of the moving body in the + direction of M
};

// The slope of a line through a curved motion depends on the range of the fit. Two motions are
// therefore compared only over the travel that both runs cover. Errors: the runs measure two axes;
// a run has no points; the common travel is less than half of the longer travel.
Result<CommonTravel> over_common_travel(const Run& a, const Run& b);

// Fits a line to each straightness error (mean of both approaches; the reference point is the
// fixture) over the travel that both runs cover. parallelism_budgets() calculates the budgets from
// the result of over_common_travel(). Target and fixture must not be moved on the
// machine between the two runs. The runs do not show such a movement, so the user must prevent it.
// Errors: runs of two different axes; fewer than three targets in the common travel; the errors of
// over_common_travel() and check_usable().
Result<Parallelism> parallelism(const Run& run_a, const Run& run_b, bool take_partial = false);

}  // namespace mdof::algo
