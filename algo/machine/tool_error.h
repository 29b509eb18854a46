// The error of the tool against the work at a command of the machine, in the coordinates of the
// work (README.md has the equations and signs).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/machine/frames.h"

namespace mdof::algo {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // x y z (m), a b c (rad)

// Where the tool's point and directions are in the work's coordinates.
Pose nominal_tool(const Machine& machine, const Command& command);
Pose actual_tool(const Machine& machine, const std::vector<FrameValues>& values);

// By the full product of the frames: actual - nominal; angles of R = Rz(c) Ry(b) Rx(a) that takes
// the nominal tool's directions to the actual ones.
Vector6 exact_error(const Machine& machine, const Command& command,
                    const std::vector<FrameValues>& values);

// ∂ error / ∂ (one error of one frame), at no errors. What the error is not known to be counts too.
struct ErrorDerivative {
  std::size_t frame = 0, k = 0;  // of Machine::frames; of the six
  bool of_line = false;          // a location error; else an error of the body
  Vector6 d = Vector6::Zero();
};
// All errors that the machine can have, frame by frame.
std::vector<ErrorDerivative> derivatives(const Machine& machine, const Command& command);

// What one standard uncertainty of each part that frames share (FrameValues::shared) does to the
// tool.
std::vector<Vector6> shared_effects(const std::vector<ErrorDerivative>& derivatives,
                                    const std::vector<FrameValues>& values);

// The other linear axis of a squareness: a turn of one line says the same as that turn of the other
// line with the other sign (EC0X and EC0Y). nullptr: no squareness, or no such axis.
const MachineFrame* other_of_square(const Machine& machine, const ErrorDerivative& d);

// Sum of derivative times error.
Vector6 linear_error(const std::vector<ErrorDerivative>& derivatives,
                     const std::vector<FrameValues>& values);
// Standard uncertainty by those of the errors: of one body with their correlation, of different
// bodies with that by their shared parts, of lines independent. 0: none declared.
Vector6 error_uncertainty(const std::vector<ErrorDerivative>& derivatives,
                          const std::vector<FrameValues>& values);

// More than |exact - linear| can be, as vectors: of the place, m, and of each angle, rad.
struct LinearBound {
  double place_m = 0, angle_rad = 0;
};
LinearBound linear_bound(const Machine& machine, const Command& command,
                         const std::vector<FrameValues>& values);

// Everything said of one command.
struct ToolError {
  Vector6 exact, linear, u;  // u: NaN where it is 0 and something that counts has none
  LinearBound bound;
  // By component: names of errors that were not measured and would count; that have no u.
  std::array<std::vector<std::string>, 6> not_measured, no_u;
  std::vector<std::string> beyond;  // whose table ends before this command: its end is held
};
ToolError tool_error(const Machine& machine, const Command& command, MachineApproach approach);

// Those of `names` that are not in the list yet: of many commands.
void add_new(const std::vector<std::string>& names, std::vector<std::string>& to);

}  // namespace mdof::algo
