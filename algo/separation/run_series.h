// Converts a stored run to a set-up of a separation. The readings of the set-up are the means of
// both approaches at the targets of the run.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "algo/separation/set_up.h"
#include "schema/base/result.h"
#include "schema/rig/rig.h"
#include "schema/run.h"

namespace mdof::algo {

// Uses the error with index `named` in error_names(), at the reference point of the run. u contains
// noise and repeatability. The caller sets turn and shift.
SetUp error_series(const Run& run, std::size_t named);

// Changes of the errors of error_series() by one standard uncertainty of each quantity that the rig
// declares. Does not include the flatness of planes perpendicular to `normal`, because the
// separation determines this surface. Error: as contributors().
Result<std::vector<DeclaredShift>> declared_shifts(const Run& run, const Rig& rig,
                                                   std::size_t named, Axis normal);

// The readings of one probe as the error of the moving body at this probe. They do not depend on
// the surfaces that other probes measure.
struct ProbeSeries {
  SetUp set_up;
  Vec3 position_m{};  // position of the probe in M, machine axes
};
// `set_up.declared` contains the sensitivity of the probe and the drift of the probe since the
// start of the run. Errors: the rig has no such probe; the probe does not measure along `normal`.
Result<ProbeSeries> probe_series(const Run& run, const Rig& rig, const std::string& probe,
                                 Axis normal);

}  // namespace mdof::algo
