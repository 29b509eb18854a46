// Quantities that the tables of several axes share: the scale, linearity and tilt factor of a probe
// that measured more than one axis. The u of a point that several axes move needs them.
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

// A table with the data it was built from; one rig for each run.
struct BuiltFrom {
  CompensationTable table;
  std::vector<Rig> rigs;
  std::vector<Run> runs;
  TableOptions options;
};

// An independent part of a quantity that at least two tables share: the effect of one standard
// uncertainty on the named errors of the forward approach, [table][position]; 0 in tables without
// it.
struct SharedQuantity {
  ContributorName name;
  std::vector<std::vector<Errors5>> by_table;
};

// Probes with the same certificate and uncertainty are the same probe, as for the squareness of two
// runs (uncertainty/statistics/common_quantities.h). Errors: those of contributors(); a table with
// too many points, because this takes long.
Result<std::vector<SharedQuantity>> shared_quantities(const std::vector<BuiltFrom>& tables);

}  // namespace mdof::algo
