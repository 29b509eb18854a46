// Propagates the uncertainties that the rigs of a table's runs declare to the values of the table.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Sets `u_declared` of a table that build_table() made from these runs and options; `rigs` has the
// rig of each run. The table is built again with the shift of each contributor, so that shifts
// common to all points cancel where the table takes differences (the line, the first angle). A
// contributor that several rigs declare identically belongs to one fixture and shifts their runs
// together. u_declared contains the uncertainty of a removed drift, too. It is not set if no rig
// declares an uncertainty and no drift was removed. Errors: those of contributors(); too many
// points and contributors, because this takes long.
Status add_declared_uncertainty(CompensationTable& table, const std::vector<Rig>& rigs,
                                const std::vector<Run>& runs, const TableOptions& options);

// The same uncertainty as covariance of the five errors at each position, by approach; empty if
// nothing is declared.
struct DeclaredCovariance {
  std::vector<Covariance5> forward, reverse;  // named errors
};
Result<DeclaredCovariance> declared_covariance(const CompensationTable& table,
                                               const std::vector<Rig>& rigs,
                                               const std::vector<Run>& runs,
                                               const TableOptions& options);

}  // namespace mdof::algo
