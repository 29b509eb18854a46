// The command that compensates the errors of the machine at a wanted command.
#pragma once

#include <array>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct CompensatingCommand {
  Command command{};
  Eigen::Vector3d residual_m;  // tool's point, by the full product, in the work's coordinates
  Eigen::Vector3d angles_rad;  // remaining angles: linear axes turn nothing
  int steps = 0;
  bool converged = false;           // another step changes less than 1e-12 m
  std::vector<std::string> beyond;  // as in ToolError, at the new command
};

// Fixed-point iteration over the linear axes, c ← c + J⁻¹ (wanted - reached), with J of the nominal
// machine; rotary axes keep their commands. With fewer than three linear axes the residual contains
// the directions that they cannot reach. The contraction factor is about the slope of the errors
// over the travel, at most 1e-3 for machines. Error: the chain has no linear axis.
Result<CompensatingCommand> compensating_command(const Machine& machine, const Command& wanted,
                                                 MachineApproach approach);

// The command at which the nominal tool is at `place_m` in the work's coordinates, measured from
// its place when all commands are 0: place / s_k for an axis along X, Y or Z (s_k of
// schema/rig/correction.h). The commands of rotary axes, and of axes that the chain does not have,
// are 0.
Command command_at_place(const Machine& machine, const Eigen::Vector3d& place_m);

// Directions of the work's coordinates (orthonormal columns) in which no linear axis moves the tool
// while the rotary axes keep their positions: two axes are parallel there, or the chain has fewer
// than three. Without columns the axes move the tool in all directions.
Eigen::MatrixXd fixed_directions(const Machine& machine, const Command& command);

// derivatives() with the place in the commands of X, Y, Z instead of the work's coordinates, whose
// directions a rotary axis changes: the effect of a unit of each error on the correction, except
// for its sign. 0 for an axis that the chain does not have.
std::vector<ErrorDerivative> command_derivatives(const Machine& machine, const Command& command);

// Difference of the corrections of X, Y, Z between the approaches of the axes at a command, m. For
// each axis it is forward minus reverse with the other axes at their means; the magnitudes are
// added, because each axis may come from either side. First order in the errors.
std::array<double, 3> command_reversal(const Machine& machine, const Command& command);

}  // namespace mdof::algo
