// Noise of the tables of a machine's axes in the values of a volumetric table. At a target of an
// axis it is one draw for all nodes with that command; between two nodes straight lines average the
// two, so that the variance is that of the sum, (1-p)² V0 + 2 p (1-p) C + p² V1, axis by axis.
#pragma once

#include <array>

#include "algo/machine/frames.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// The nodes about a command along an axis of the grid.
struct GridCell {
  std::size_t index = 0;  // of the node below
  double part = 0;        // of the way to the next
  bool inside = true;
};

// Sets `noise` of the table, whose commands are set, from u_independent of the errors of the
// machine and their correlation. The effect of an error on the tool is linear in the commands
// (derivatives()); noise at different targets of an axis is independent and goes in straight lines
// between them, where grid and targets differ. Not set where no error has such a part.
void set_noise_of_axes(VolumetricTable& table, const Machine& machine, const Command& others,
                       MachineApproach approach);

// Variances by it of the correction of X, Y, Z at a command, m².
Vec3 noise_variance(const VolumetricTable& table, const std::array<GridCell, 3>& cell,
                    const Vec3& command_m);

}  // namespace mdof::algo
