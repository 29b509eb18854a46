// Covariance of the errors of a table: one set of probes shows all five, so that a fault of a probe
// moves several at once. u of a place with a lever needs it.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Of the named errors, by position; of both approaches the larger variance, so that it holds for
// the value of either and of their mean.
struct ErrorCovariances {
  std::vector<Covariance5> noise;     // and repeatability
  std::vector<Covariance5> declared;  // by what the rigs declare; empty: nothing
};

// What rigs declare goes in as it shifts the table; noise as equal noise of all probes makes it,
// through the solver and what the values refer to. `table` is build_table() of these runs and
// options; noise that is not known (NaN) counts as the largest of the other positions. Errors: as
// of declared_covariance(); a rig that cannot see all five errors.
Result<ErrorCovariances> error_covariances(const CompensationTable& table,
                                           const std::vector<Rig>& rigs,
                                           const std::vector<Run>& runs,
                                           const TableOptions& options);

}  // namespace mdof::algo
