// What the tables of several axes have in common: the scale, the linearity and the tilt factor of a
// probe that measured more than one of them. u of a place that several axes take to needs it.
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

// A table with what it was built from; one rig a run.
struct BuiltFrom {
  CompensationTable table;
  std::vector<Rig> rigs;
  std::vector<Run> runs;
  TableOptions options;
};

// An independent part of a quantity that two tables or more have: what one standard uncertainty of
// it does to the named errors of the forward approach. [table][position]; 0 in the others.
struct SharedQuantity {
  ContributorName name;
  std::vector<std::vector<Errors5>> by_table;
};

// The same certificate and uncertainty are the same probe, as for the squareness of two runs
// (uncertainty/statistics/common_quantities.h). Errors: those of contributors(); a table of so
// many points that it would take long.
Result<std::vector<SharedQuantity>> shared_quantities(const std::vector<BuiltFrom>& tables);

}  // namespace mdof::algo
