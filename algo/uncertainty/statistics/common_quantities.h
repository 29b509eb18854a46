// Which contributors of two set-ups are one quantity.
#pragma once

#include <vector>

#include "algo/uncertainty/contributors.h"
#include "schema/rig/rig.h"

namespace mdof::algo {

// Sets Contributor::common_as: the scale, the linearity and the tilt factor of a probe are its own
// wherever it is clamped; the same id, certificate and uncertainty are the same probe.
void name_what_goes_with_probes(const Rig& rig, std::vector<Contributor>& list);

}  // namespace mdof::algo
