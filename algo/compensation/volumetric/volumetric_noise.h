// Calculates how the noise of the axis tables changes the values of a volumetric table. All nodes
// with the same command of an axis have the same noise of this axis. At the share p of the way
// between two nodes with the variances V0 and V1 and the covariance C, linear interpolation gives
// for each axis the variance
// (1-p)² V0 + 2 p (1-p) C + p² V1.
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

// Sets `noise` of the table from u_independent of the machine's errors and from their correlation.
// The commands of the table must be set. The effect of an error on the tool is linear in the
// commands (derivatives()). Noise at different targets of an axis is independent. The nodes of the
// grid can be between the targets, so the noise is interpolated linearly between the targets.
// `noise` is not set if no error has an independent part.
void set_axis_noise(VolumetricTable& table, const Machine& machine, const Command& others,
                    MachineApproach approach);

// Returns the variances of the corrections of X, Y, Z at a command due to this noise, m².
Vec3 noise_variance(const VolumetricTable& table, const std::array<GridCell, 3>& cell,
                    const Vec3& command_m);

}  // namespace mdof::algo
