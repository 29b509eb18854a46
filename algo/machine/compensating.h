// The command that brings the tool where a command should have brought it.
#pragma once

#include <array>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct CompensatingCommand {
  Command command{};
  Eigen::Vector3d residual_m;  // of the tool's point by the full product, in the work's coordinates
  Eigen::Vector3d angles_rad;  // that stay: linear axes turn nothing
  int steps = 0;
  bool converged = false;           // another step changes nothing above 1e-12 m
  std::vector<std::string> beyond;  // as of ToolError, at the new command
};

// Fixed point over the linear axes, c ← c + J⁻¹ (wanted - reached), J of the nominal machine;
// rotary axes stay where they are. With fewer than three linear axes the residual has what they
// cannot reach. The fixed point contracts by about the slope of the errors over the travel, 1e-3
// and less for machines. Error: the chain has no linear axis.
Result<CompensatingCommand> compensating_command(const Machine& machine, const Command& wanted,
                                                 MachineApproach approach);

// The command at which the nominal tool is at `place_m` in the work's coordinates, measured from
// where it is when all commands are 0: place / s_k for an axis along X, Y or Z (s_k of
// schema/rig/correction.h). Rotary axes are at 0, and so is an axis that the chain has not.
Command command_at_place(const Machine& machine, const Eigen::Vector3d& place_m);

// Directions of the work's coordinates (orthonormal columns) in which no linear axis moves the tool
// while the rotary axes are where they are: two axes are parallel there, or the chain has fewer
// than three. No columns: the axes move the tool in all directions.
Eigen::MatrixXd fixed_directions(const Machine& machine, const Command& command);

// derivatives() with the place in the commands of X, Y, Z in place of the work's coordinates, in
// which a turned rotary axis has other directions: what a unit of each error does to the
// correction, but for its sign. 0 for an axis that the chain has not.
std::vector<ErrorDerivative> derivatives_of_command(const Machine& machine, const Command& command);

// By how much the corrections of X, Y, Z differ with the approaches of the axes, at a command: of
// each axis forward less reverse while the others are at their means, as magnitudes added, since
// each may come from either side; m. First order in the errors.
std::array<double, 3> reversal_of_command(const Machine& machine, const Command& command);

}  // namespace mdof::algo
