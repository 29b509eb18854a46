// Quantities that the tables of several axes share, for example the scale, linearity and tilt
// factor of a probe that measured more than one axis. The u of a point that several axes move
// depends on these quantities.
#pragma once

#include <string>
#include <vector>

#include "algo/compensation/compensation.h"
#include "schema/base/result.h"
#include "schema/compensation_table.h"
#include "schema/rig/rig.h"
#include "schema/run.h"
#include "schema/uncertainty/contributor_name.h"

namespace mdof::algo {

// A table with the data from which it was built; `rigs` has one rig for each run.
struct BuiltFrom {
  CompensationTable table;
  std::vector<Rig> rigs;
  std::vector<Run> runs;
  TableOptions options;
};

// An independent part of a quantity that at least two tables share. `by_table` is the effect of one
// standard uncertainty on the named errors of the forward approach, as [table][position]; 0 in
// tables without this quantity.
struct SharedQuantity {
  ContributorName name;
  std::vector<std::vector<Errors5>> by_table;
};

// Probes with the same certificate and uncertainty count as the same probe, as in
// uncertainty/statistics/common_quantities.h for the squareness of two runs. Errors: the errors of
// contributors(); a table with so many points that the calculation would take too long.
Result<std::vector<SharedQuantity>> shared_quantities(const std::vector<BuiltFrom>& tables);

}  // namespace mdof::algo
