// The command that compensates the errors of the machine at a wanted command.
#pragma once

#include <array>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct CompensatingCommand {
  Command command{};
  Eigen::Vector3d residual_m;  // remaining error of the tool's point, calculated with the full
                               // product of the frames, in the coordinates of the work
  Eigen::Vector3d angles_rad;  // remaining angles of the tool; linear axes cannot correct angles
  int steps = 0;
  bool converged = false;           // the last step changed the commands by less than 1e-12 m
  std::vector<std::string> beyond;  // as ToolError::beyond, at `command`
};

// Corrects the commands c of the linear axes by the fixed-point iteration
//   c ← c + J⁻¹ (wanted place - reached place),   J: Jacobian of the nominal machine
// The commands of rotary axes do not change. With fewer than three linear axes, the residual
// contains the components in the directions in which these axes cannot move the tool. Each step
// multiplies the residual by about the slope of the errors over the travel, which is at most 1e-3
// in machines. Error: the chain has no linear axis.
Result<CompensatingCommand> compensating_command(const Machine& machine, const Command& wanted,
                                                 MachineApproach approach);

// The command at which the nominal tool is at `place_m`. The origin of `place_m` is the place of
// the tool when all commands are 0; its components are in the coordinates of the work. For an axis
// along X, Y or Z the command is place / s_k (s_k of schema/rig/correction.h). The commands of
// rotary axes, and of axes that the chain does not have, are 0.
Command command_at_place(const Machine& machine, const Eigen::Vector3d& place_m);

// Directions (orthonormal columns, coordinates of the work) in which no linear axis can move the
// tool while the rotary axes do not move. There are such directions if the chain has fewer than
// three linear axes, or if two linear axes are parallel at this command. No column: the linear axes
// can move the tool in all directions.
Eigen::MatrixXd fixed_directions(const Machine& machine, const Command& command);

// Like derivatives(), but the first three components are the changes of the commands X, Y and Z
// that have the same effect on the tool's place as one unit of the error. The correction of the
// error is the opposite change. 0 for an axis that the chain does not have.
std::vector<ErrorDerivative> command_derivatives(const Machine& machine, const Command& command);

// Largest difference of the corrections of X, Y and Z between forward and reverse approach at a
// command, m. For each axis, the correction is calculated for both approaches of this axis, with
// the mean errors of the other axes. The absolute differences of all axes are added, because the
// approaches of the axes are independent. First order in the errors.
std::array<double, 3> command_reversal(const Machine& machine, const Command& command);

}  // namespace mdof::algo
