// Solves one point. Lists the ids and the ranges of the probes of a rig.
#pragma once

#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/chi_square.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// The ids and the ranges are in the order of the probes of the rig.
std::vector<std::string> probe_ids(const Rig& rig);
std::vector<double> probe_ranges_m(const Rig& rig);

// Calculates the errors of the point. Their reference point is the fixture. If the point has no
// errors, it gets a reason. The reason begins with the cause that the flags of the point state.
void solve_point(const algo::Solver& solver, const Rig& rig, const algo::Residuals& residuals,
                 MeasuredPoint& p);

}  // namespace mdof::daemon
