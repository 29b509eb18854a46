// One frame of the chain: its motion, its errors, and their effect on a point (README.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algo/machine/pose.h"
#include "schema/machine/machine.h"

namespace mdof::algo {

// Commands of X Y Z (m) and A B C (rad); 0 for an axis that the chain does not have.
using Command = std::array<double, 6>;
enum class MachineApproach { mean, forward, reverse };  // approach of all axes

// Values of a frame's description at a command.
struct FrameValues {
  double travel = 0;                             // travel of the body along + of its axis, m or rad
  std::array<double, kBodyErrors> error{};       // 0 where not measured
  std::array<double, kBodyErrors> location{};    // 0 where not measured
  std::array<double, kBodyErrors> u_location{};  // 0 where not declared
  // u of the errors of the body as independent parts: element (k, q) is the effect of one standard
  // uncertainty of part q on error k; lower triangle, diagonal if no errors are correlated. Between
  // positions it is linear, and includes the error of the straight-line interpolation. `shared`:
  // additional parts that other frames have too, by number.
  Eigen::Matrix<double, kBodyErrors, kBodyErrors> u_parts =
      Eigen::Matrix<double, kBodyErrors, kBodyErrors>::Zero();
  std::vector<std::array<double, kBodyErrors>> shared;
  // The same for the part that is independent from position to position of the axis.
  Eigen::Matrix<double, kBodyErrors, kBodyErrors> noise_parts =
      Eigen::Matrix<double, kBodyErrors, kBodyErrors>::Zero();
  std::array<bool, kBodyErrors> beyond{};  // as in TablePlace
};
FrameValues values_at(const MachineFrame& frame, const Command& command, MachineApproach approach);
std::vector<FrameValues> values_at(const Machine& machine, const Command& command,
                                   MachineApproach approach);

// A position outside a table by less than this part of the last interval counts as its end, because
// a stop deviates as much from its target.
constexpr double kEndTolerance = 0.02;

// Place of a command in a table of an error: the position below it, and the part of the way to the
// next one.
struct TablePlace {
  std::size_t cell = 0;
  double part = 0;
  bool beyond = false;  // outside by more than kEndTolerance
};
TablePlace place_of(const std::vector<double>& position, double at);
// Linear interpolation between two values; 0 without values.
double value_at(const std::vector<double>& values, const TablePlace& place);

double command_of(const MachineFrame& frame, const Command& command);
// Travel of the frame's body along + of its axis.
double travel_of(const MachineFrame& frame, const Command& command);

Pose nominal_pose(const MachineFrame& frame, double travel);
// The true displacement of the frame's body: the motion along the true line of the axis, then the
// body's errors, stated at holding_point().
Pose actual_pose(const MachineFrame& frame, const FrameValues& values);
// The point at which the errors of the body are stated, at this travel.
Eigen::Vector3d holding_point(const MachineFrame& frame, double travel);

}  // namespace mdof::algo
