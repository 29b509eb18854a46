// Finds contributors of two set-ups that are one quantity.
#pragma once

#include <string>
#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Sets Contributor::common_as. The scale, the linearity and the tilt factor of a probe belong to it
// wherever it is clamped; the same id and certificate mean the same probe. If two rigs declare
// different u, each rig uses its own u of this one quantity.
void name_probe_correlations(const Rig& rig, std::vector<Contributor>& list);

// `plane` must be one of the rig's.
ContributorName flatness_name(const Rig& rig, const TargetPlane& plane);
// Sets Contributor::surface_as. The same name, normal, uncertainty and length mean the same plane
// of one target, which is over the same place of M at d = 0 in both runs.
void name_common_surfaces(const Rig& rig, std::vector<Contributor>& list);

// The parts of all contributors of two runs. The parts of a common surface, whose common_as is set,
// are calculated together: part p of one run is the same quantity as part p of the other.
struct TwoRunParts {
  std::vector<std::vector<PointShifts>> a, b;  // [contributor][part]
};
TwoRunParts parts_of_both_runs(std::vector<Contributor>& of_a, Axis along_a,
                               std::vector<Contributor>& of_b, Axis along_b);

}  // namespace mdof::algo
