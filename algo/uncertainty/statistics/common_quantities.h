// Finds contributors of two set-ups that are the same physical quantity.
#pragma once

#include <string>
#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Sets Contributor::common_as. The sensitivity, the linearity and the tilt factor of a probe do not
// change with the set-up. Two probes with the same id and certificate are the same probe. If two
// rigs declare different u for the quantity, each rig uses the u that it declares.
void name_probe_correlations(const Rig& rig, std::vector<Contributor>& list);

// `plane` must be an element of rig.planes.
ContributorName flatness_name(const Rig& rig, const TargetPlane& plane);
// Sets Contributor::surface_as. Planes with the same name, normal, uncertainty and length are taken
// as the same plane of one target. At d = 0 this plane must be at the same place of frame M in both
// runs.
void name_common_surfaces(const Rig& rig, std::vector<Contributor>& list);

// The parts of all contributors of two runs. The parts of a common surface are calculated together,
// and common_as of its contributors is set. Then part p of one run is the same quantity as part p
// of the other run.
struct TwoRunParts {
  std::vector<std::vector<PointShifts>> a, b;  // [contributor][part]
};
TwoRunParts parts_of_both_runs(std::vector<Contributor>& of_a, Axis along_a,
                               std::vector<Contributor>& of_b, Axis along_b);

}  // namespace mdof::algo
