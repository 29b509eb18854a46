// Propagates the declared uncertainties of the rigs to the values of a table.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Sets `u_declared` of a table that build_table() calculated from these runs and options; `rigs`
// has the rig of each run. The table is calculated again with the shift of each contributor. A
// shift that is the same at all points cancels where the table subtracts a reference (the line of
// straightness, the first angle). If several rigs declare the same contributor, mdof assumes that
// they describe one fixture: the contributor shifts the runs of all these rigs together. u_declared
// also contains the uncertainty of a removed drift. u_declared is not set if no rig declares an
// uncertainty and no drift was removed. Errors: the errors of contributors(); so many points and
// contributors that the calculation would take too long.
Status add_declared_uncertainty(CompensationTable& table, const std::vector<Rig>& rigs,
                                const std::vector<Run>& runs, const TableOptions& options);

// The declared uncertainty as the covariance of the five errors at each position, for each
// approach; empty if no uncertainty is declared.
struct DeclaredCovariance {
  std::vector<Covariance5> forward, reverse;  // named errors
};
Result<DeclaredCovariance> declared_covariance(const CompensationTable& table,
                                               const std::vector<Rig>& rigs,
                                               const std::vector<Run>& runs,
                                               const TableOptions& options);

}  // namespace mdof::algo
