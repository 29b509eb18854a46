// Correlation of the errors of a table: one set of probes shows all five, so that a fault of a
// probe moves several at once. u of a place with a lever needs it.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Coefficients of correlation of the named errors' u, by position, of the forward approach; 1 of an
// error with itself, 0 with one whose u is 0.
struct ErrorCorrelations {
  std::vector<Covariance5> combined;  // of noise and of what is declared
  std::vector<Covariance5> noise;     // of noise and repeatability alone
};

// What rigs declare goes in as it shifts the table; noise as equal noise of all probes makes it,
// through the solver and what the values refer to. `table` is that of these runs and options with
// its u_declared. Errors: as of add_declared_uncertainty(); a rig that cannot see all five errors.
Result<ErrorCorrelations> error_correlations(const CompensationTable& table,
                                             const std::vector<Rig>& rigs,
                                             const std::vector<Run>& runs,
                                             const TableOptions& options);

}  // namespace mdof::algo
