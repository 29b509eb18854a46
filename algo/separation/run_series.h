// A stored run as a set-up of a separation: means of both approaches at its targets.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// The error with index `named` in error_names(), at the point where the run states it, with u by
// its noise and repeatability. The caller sets turn and shift.
SetUp error_series(const Run& run, std::size_t named);

// Changes of that series by the uncertainties that the rig declares, except the flatness of planes
// across `normal`: the separation determines this surface. Error: as contributors().
Result<std::vector<DeclaredShift>> declared_shifts(const Run& run, const Rig& rig,
                                                   std::size_t named, Axis normal);

// The readings of one probe alone: the error of the moving body at the probe, without the surfaces
// of other probes.
struct ProbeSeries {
  SetUp set_up;
  Vec3 position_m{};  // position of the probe in M, machine axes
};
// The declared uncertainties are its sensitivity, and its drift since the start of the run. Errors:
// the rig has no such probe; the probe does not measure along `normal`.
Result<ProbeSeries> probe_series(const Run& run, const Rig& rig, const std::string& probe,
                                 Axis normal);

}  // namespace mdof::algo
