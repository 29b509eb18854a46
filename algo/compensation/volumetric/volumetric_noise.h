// Noise of the tables of a machine's axes in the values of a volumetric table. The noise at a
// target of an axis is the same for all nodes with this command. Between two nodes linear
// interpolation averages both, so the variance is that of the sum, (1-p)² V0 + 2 p (1-p) C + p² V1,
// axis by axis.
#pragma once

#include <array>

#include "algo/machine/frames.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// The nodes next to a command along an axis of the grid.
struct GridCell {
  std::size_t index = 0;  // index of the lower node
  double part = 0;        // share of the distance to the next node
  bool inside = true;
};

// Sets `noise` of the table, whose commands are set, from u_independent of the errors of the
// machine and from their correlation. The effect of an error on the tool is linear in the commands
// (derivatives()). Noise at different targets of an axis is independent; between targets it is
// interpolated linearly, because grid and targets can differ. `noise` is not set if no error has an
// independent part.
void set_axis_noise(VolumetricTable& table, const Machine& machine, const Command& others,
                    MachineApproach approach);

// Variances of the correction of X, Y, Z at a command due to this noise, m².
Vec3 noise_variance(const VolumetricTable& table, const std::array<GridCell, 3>& cell,
                    const Vec3& command_m);

}  // namespace mdof::algo
