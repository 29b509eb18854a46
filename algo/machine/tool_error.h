// Error of the tool relative to the work at a command of the machine, in the coordinates of the
// work (README.md has the equations and signs).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/machine/frames.h"

namespace mdof::algo {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // x y z (m), a b c (rad)

// Pose of the tool's point and directions in the work's coordinates.
Pose nominal_tool(const Machine& machine, const Command& command);
Pose actual_tool(const Machine& machine, const std::vector<FrameValues>& values);

// Error by the full product of the frames: actual - nominal; the angles are those of the rotation R
// = Rz(c) Ry(b) Rx(a) from the nominal to the actual directions of the tool.
Vector6 exact_error(const Machine& machine, const Command& command,
                    const std::vector<FrameValues>& values);

// ∂ error / ∂ (one error of one frame), at errors of 0. An unknown error also has a derivative.
struct ErrorDerivative {
  std::size_t frame = 0, k = 0;  // index in Machine::frames; one of the six errors
  bool of_line = false;          // a location error; else an error of the body
  Vector6 d = Vector6::Zero();
};
// Derivatives for all errors that the machine can have, frame by frame.
std::vector<ErrorDerivative> derivatives(const Machine& machine, const Command& command);

// Effect on the tool of one standard uncertainty of each part that frames share
// (FrameValues::shared).
std::vector<Vector6> shared_effects(const std::vector<ErrorDerivative>& derivatives,
                                    const std::vector<FrameValues>& values);

// The other linear axis of a squareness: a rotation of one line is equivalent to the opposite
// rotation of the other line (EC0X and EC0Y). nullptr: no squareness, or no such axis.
const MachineFrame* squareness_partner(const Machine& machine, const ErrorDerivative& d);

// Sum of derivative times error.
Vector6 linear_error(const std::vector<ErrorDerivative>& derivatives,
                     const std::vector<FrameValues>& values);
// Standard uncertainty by those of the errors: the errors of one body with their correlation, those
// of different bodies with the correlation by their shared parts, lines as independent. 0: no
// uncertainty is declared.
Vector6 error_uncertainty(const std::vector<ErrorDerivative>& derivatives,
                          const std::vector<FrameValues>& values);

// Upper bound of |exact - linear|, as vectors: of the place, m, and of each angle, rad.
struct LinearBound {
  double place_m = 0, angle_rad = 0;
};
LinearBound linear_bound(const Machine& machine, const Command& command,
                         const std::vector<FrameValues>& values);

// All results for one command.
struct ToolError {
  Vector6 exact, linear, u;  // u: NaN if it is 0 and a contributing error has no u
  LinearBound bound;
  // By component: names of contributing errors that were not measured, and of those without u.
  std::array<std::vector<std::string>, 6> not_measured, no_u;
  std::vector<std::string> beyond;  // errors whose table ends before this command: end value used
};
ToolError tool_error(const Machine& machine, const Command& command, MachineApproach approach);

// Appends the names that `to` does not contain yet, to collect the names of several commands.
void add_new(const std::vector<std::string>& names, std::vector<std::string>& to);

}  // namespace mdof::algo
