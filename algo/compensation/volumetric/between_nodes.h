// The uncertainty of the corrections of a volumetric table between its nodes.
#pragma once

#include <array>

#include "algo/machine/frames.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

// Sets `u_between_m` of the table; all other members of the table must be set. At a command on an
// edge between two nodes, u_between² is the variance of the correction without the noise of the
// grid's axes, minus the square of the same u interpolated between the two nodes. Linear
// interpolation between nodes at measured positions has no error relative to the model, because the
// model is linear there, too; but the true errors are not linear (README.md of algo/machine, i).
// u_between is calculated at each position of the tables of the axis inside the cell, and in the
// middle of each interval between such positions and the nodes. The interpolation uncertainties of
// different axes are independent, so they are stored for each axis separately.
void set_u_between_nodes(VolumetricTable& table, const Machine& machine, const Command& others,
                         MachineApproach approach);

}  // namespace mdof::algo
