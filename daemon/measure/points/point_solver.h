// The errors of one point, and what of a rig those who make points ask for.
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

// Stated at the fixture. A point without errors says why, the cause in its flags first.
void solve_point(const algo::Solver& solver, const Rig& rig, const algo::Residuals& residuals,
                 MeasuredPoint& p);

}  // namespace mdof::daemon
