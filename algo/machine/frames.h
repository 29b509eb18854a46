// Motion and errors of one frame of the chain, as the displacement of a point (README.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algo/machine/pose.h"
#include "schema/machine/machine.h"

namespace mdof::algo {

// Commands of X Y Z (m) and A B C (rad); 0 for an axis that the chain does not have.
using Command = std::array<double, 6>;
enum class MachineApproach { mean, forward, reverse };  // the same for all axes

// Motion, errors and uncertainties of a frame at a command.
struct FrameValues {
  double travel = 0;  // motion of the body in the + direction of its axis, m or rad
  std::array<double, kBodyErrors> error{};       // of the body, m or rad; 0 where not measured
  std::array<double, kBodyErrors> location{};    // errors of the axis line; 0 where not measured
  std::array<double, kBodyErrors> u_location{};  // 0 where not declared
  // The uncertainty of the errors of the body, as a sum of independent parts. Element (k, q) is the
  // effect of one standard uncertainty of part q on error k. The matrix is a lower triangle, and a
  // diagonal if no errors are correlated. Between the positions of the tables, the standard
  // uncertainty is interpolated linearly, and combined with the uncertainty of the straight-line
  // interpolation. Parts that several frames have in common are not in `u_parts`, but in `shared`:
  // shared[p][k] is the effect of common part p on error k. A part has the same p in all frames.
  Eigen::Matrix<double, kBodyErrors, kBodyErrors> u_parts =
      Eigen::Matrix<double, kBodyErrors, kBodyErrors>::Zero();
  std::vector<std::array<double, kBodyErrors>> shared;
  // Like u_parts, for the noise only. The noise is independent from position to position of the
  // axis.
  Eigen::Matrix<double, kBodyErrors, kBodyErrors> noise_parts =
      Eigen::Matrix<double, kBodyErrors, kBodyErrors>::Zero();
  // The command is beyond the table of the error; see TablePlace.
  std::array<bool, kBodyErrors> beyond{};
};
FrameValues values_at(const MachineFrame& frame, const Command& command, MachineApproach approach);
std::vector<FrameValues> values_at(const Machine& machine, const Command& command,
                                   MachineApproach approach);

// A command can be outside a table by this share of the last interval and is still treated as the
// end of the table. Measured stops deviate from their targets by about this share.
constexpr double kEndTolerance = 0.02;

// Place of a command in the table of an error: index `cell` of the position below the command, and
// the share `part` (0 to 1) of the interval to the next position.
struct TablePlace {
  std::size_t cell = 0;
  double part = 0;
  bool beyond = false;  // the command is outside the table by more than kEndTolerance
};
TablePlace place_of(const std::vector<double>& position, double at);
// Linear interpolation between two values; 0 without values.
double value_at(const std::vector<double>& values, const TablePlace& place);

double command_of(const MachineFrame& frame, const Command& command);
// Motion of the frame's body in the + direction of its axis, m or rad.
double travel_of(const MachineFrame& frame, const Command& command);

Pose nominal_pose(const MachineFrame& frame, double travel);
// The actual displacement of the frame's body: first the motion along the actual axis line, then
// the errors of the body. The reference point of the translations is holding_point().
Pose actual_pose(const MachineFrame& frame, const FrameValues& values);
// The reference point of the translations of the body's errors, after this travel (Q in README.md).
Eigen::Vector3d holding_point(const MachineFrame& frame, double travel);

}  // namespace mdof::algo
