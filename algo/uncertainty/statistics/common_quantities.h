// Which contributors of two set-ups are one quantity.
#pragma once

#include <string>
#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Sets Contributor::common_as: the scale, the linearity and the tilt factor of a probe are its own
// wherever it is clamped; the same id and certificate are the same probe. Where two rigs declare
// another u of it, each has its own, of one quantity.
void name_probe_correlations(const Rig& rig, std::vector<Contributor>& list);

// The plane is one of the rig's.
ContributorName flatness_name(const Rig& rig, const TargetPlane& plane);
// Sets Contributor::surface_as: the same name, normal, uncertainty and length are the same plane of
// one target, which is over the same place of M at d = 0 of both runs.
void name_common_surfaces(const Rig& rig, std::vector<Contributor>& list);

// The parts of all contributors of two runs; those of a common surface, whose common_as is set, are
// made together, so that part p of the one is the same quantity as part p of the other.
struct PartsOfTwo {
  std::vector<std::vector<PointShifts>> a, b;  // [contributor][part]
};
PartsOfTwo parts_of_two(std::vector<Contributor>& of_a, Axis along_a,
                        std::vector<Contributor>& of_b, Axis along_b);

}  // namespace mdof::algo
