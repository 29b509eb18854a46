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

// The error at `named` in the order of error_names(), at the point where the run is stated, with u
// of its noise and repeatability. Turn and shift are the caller's.
SetUp error_series(const Run& run, std::size_t named);

// What the rig declares, by what it changes of that series, with all but the flatness of planes
// across `normal`: the surface that is looked at is what a separation finds. Error: as
// contributors().
Result<std::vector<DeclaredShift>> declared_shifts(const Run& run, const Rig& rig,
                                                   std::size_t named, Axis normal);

// The readings of one probe alone: the error of the moving body where the probe stands, with no
// other probe's surface in it.
struct ProbeSeries {
  SetUp set_up;
  Vec3 position_m{};  // of the probe in M, machine axes
};
// What is declared of it: its sensitivity, and its drift since the start of the run.
// Errors: no such probe in the rig, one that does not look along `normal`.
Result<ProbeSeries> probe_series(const Run& run, const Rig& rig, const std::string& probe,
                                 Axis normal);

}  // namespace mdof::algo
