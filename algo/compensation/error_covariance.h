// Covariance of the errors of a table. One set of probes measures all five errors, so a fault of
// one probe changes several of them. The u of a point with a lever arm needs this covariance.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Covariances of the named errors by position. Each variance is the larger one of the two
// approaches, so that it holds for the value of either approach and for their mean.
struct ErrorCovariances {
  std::vector<Covariance5> noise;     // noise and repeatability
  std::vector<Covariance5> declared;  // declared by the rigs; empty: nothing declared
};

// The declared part is propagated by shifts of the table. Noise is taken as equal for all probes
// and propagated through the solver and the references of the values. `table` is the result of
// build_table() for these runs and options. Unknown noise (NaN) is replaced by the largest of the
// other positions. Errors: those of declared_covariance(); a rig that does not measure all five
// errors.
Result<ErrorCovariances> error_covariances(const CompensationTable& table,
                                           const std::vector<Rig>& rigs,
                                           const std::vector<Run>& runs,
                                           const TableOptions& options);

}  // namespace mdof::algo
