// What the rigs of a table's runs declare not to know, carried to the values of the table.
#pragma once

#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Sets `u_declared` of a table that build_table() made of these runs and options; `rigs` are those
// of the runs, one each. The table is built again with each contributor's shift: so what is common
// to all points cancels where the table takes differences (the line, the first angle). A
// contributor that several rigs declare alike is the same fixture's: it shifts their runs together.
// Nothing is set where no rig declares anything and no drift was removed. What the removal of a
// drift adds is in it, too. Errors: those of contributors(); so many points and contributors that
// it would take long.
Status add_declared_uncertainty(CompensationTable& table, const std::vector<Rig>& rigs,
                                const std::vector<Run>& runs, const TableOptions& options);

// The same as the covariance of the five errors at each position, of each approach; empty where
// nothing is declared.
struct DeclaredCovariance {
  std::vector<Covariance5> forward, reverse;  // named errors
};
Result<DeclaredCovariance> declared_covariance(const CompensationTable& table,
                                               const std::vector<Rig>& rigs,
                                               const std::vector<Run>& runs,
                                               const TableOptions& options);

}  // namespace mdof::algo
