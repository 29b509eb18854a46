// Error of the tool relative to the work at a command of the machine, in the coordinates of the
// work (README.md has the equations and signs).
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "algo/machine/frames.h"

namespace mdof::algo {

using Vector6 = Eigen::Matrix<double, 6, 1>;  // x y z (m), a b c (rad)

// Pose of the tool in the coordinates of the work: place of the tool's point, and rotation.
Pose nominal_tool(const Machine& machine, const Command& command);
Pose actual_tool(const Machine& machine, const std::vector<FrameValues>& values);

// Error (actual - nominal), calculated with the full product of the frames. The angles a, b, c
// describe the rotation R = Rz(c) Ry(b) Rx(a) from the nominal to the actual directions of the
// tool.
Vector6 exact_error(const Machine& machine, const Command& command,
                    const std::vector<FrameValues>& values);

// Derivative of the tool's error by one error of one frame, where all errors are 0. Errors that
// were not measured also have a derivative.
struct ErrorDerivative {
  std::size_t frame = 0, k = 0;  // index in Machine::frames; error 0 to 5: EX EY EZ EA EB EC
  bool of_line = false;          // true: error of the axis line; false: error of the body
  Vector6 d = Vector6::Zero();
};
// Derivatives by all errors that the machine can have, frame after frame.
std::vector<ErrorDerivative> derivatives(const Machine& machine, const Command& command);

// Effect on the tool of one standard uncertainty of each part that several frames have in common
// (FrameValues::shared).
std::vector<Vector6> shared_effects(const std::vector<ErrorDerivative>& derivatives,
                                    const std::vector<FrameValues>& values);

// The second linear axis of a squareness. A rotation of one axis line has the same effect as the
// opposite rotation of the other axis line (EC0X and EC0Y). nullptr: `d` is not a squareness, or
// the chain does not have the second axis.
const MachineFrame* squareness_partner(const Machine& machine, const ErrorDerivative& d);

// Returns whether the error was measured. A squareness was also measured if the location error of
// the other axis is known, because both are the same angle.
bool is_measured(const Machine& machine, const ErrorDerivative& d);

// Sum over all errors of the derivative times the error.
Vector6 linear_error(const std::vector<ErrorDerivative>& derivatives,
                     const std::vector<FrameValues>& values);
// Standard uncertainty of linear_error() due to the uncertainties of the errors. Errors of one body
// are correlated as in FrameValues::u_parts. Errors of different bodies are correlated by their
// shared parts only. Errors of axis lines are independent. 0: no uncertainty is declared.
Vector6 error_uncertainty(const std::vector<ErrorDerivative>& derivatives,
                          const std::vector<FrameValues>& values);

// Upper bound of |exact_error() - linear_error()|: for the vector of the place, and for each angle.
struct LinearBound {
  double place_m = 0, angle_rad = 0;
};
LinearBound linear_bound(const Machine& machine, const Command& command,
                         const std::vector<FrameValues>& values);

// All results for one command.
struct ToolError {
  Vector6 exact, linear, u;  // u is NaN instead of 0 if the u of a contributing error is unknown
  LinearBound bound;
  // For each component of the error: names of contributing errors that were not measured, and names
  // of contributing errors without declared u.
  std::array<std::vector<std::string>, 6> not_measured, no_u;
  std::vector<std::string> beyond;  // errors whose table ends before this command; the value at the
                                    // end of the table is used
};
ToolError tool_error(const Machine& machine, const Command& command, MachineApproach approach);

// Appends those names to `to` that it does not contain yet.
void add_new(const std::vector<std::string>& names, std::vector<std::string>& to);

}  // namespace mdof::algo
