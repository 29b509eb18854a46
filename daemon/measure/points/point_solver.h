// Solves one point, and lists the probe properties that creators of points need.
#pragma once

#include <string>
#include <vector>

#include "algo/model/solver.h"
#include "algo/uncertainty/chi_square.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::daemon {

// In the order of the rig.
std::vector<std::string> probe_ids(const Rig& rig);
std::vector<double> probe_ranges_m(const Rig& rig);

// States the errors at the fixture. A point without errors gets the reason, which begins with the
// cause in its flags.
void solve_point(const algo::Solver& solver, const Rig& rig, const algo::Residuals& residuals,
                 MeasuredPoint& p);

}  // namespace mdof::daemon
