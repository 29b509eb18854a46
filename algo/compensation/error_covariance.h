// Covariance of the errors of a table. All five errors are measured with the same probes, so an
// error of one probe changes several of the five errors. This covariance is necessary for the u of
// a point with a lever arm.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Covariances of the named errors at each position. Each variance is the larger variance of the two
// approaches. It is an upper limit for the forward value, the reverse value and their mean.
struct ErrorCovariances {
  std::vector<Covariance5> noise;     // noise and repeatability
  std::vector<Covariance5> declared;  // declared by the rigs; empty: no rig declares an uncertainty
};

// `declared` is calculated as in declared_covariance(). For `noise`, all probes have the same
// noise, which is propagated through the solver and through the references of the values. `table`
// is the result of build_table() for these runs and options. Unknown noise (NaN) is replaced by the
// largest noise of the other positions. Errors: the errors of declared_covariance(); a rig that
// does not measure all five errors.
Result<ErrorCovariances> error_covariances(const CompensationTable& table,
                                           const std::vector<Rig>& rigs,
                                           const std::vector<Run>& runs,
                                           const TableOptions& options);

}  // namespace mdof::algo
