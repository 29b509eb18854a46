// One frame of the chain: its motion, its errors, and what they do to a point (README.md).
#pragma once

#include <array>
#include <string>
#include <vector>

#include "algo/machine/pose.h"
#include "schema/machine/machine.h"

namespace mdof::algo {

// Commands of X Y Z (m) and A B C (rad); of an axis that the chain has not: 0.
using Command = std::array<double, 6>;
enum class MachineApproach { mean, forward, reverse };  // the way all commands have come

// What the description says of a frame at a command.
struct FrameValues {
  double travel = 0;                             // of the body along + of its axis, m or rad
  std::array<double, kBodyErrors> error{};       // 0 where it is not measured
  std::array<double, kBodyErrors> location{};    // the same
  std::array<double, kBodyErrors> u_location{};  // 0 where it is not declared
  // u of the errors of the body as independent parts: what one standard uncertainty of part q does
  // to error k is (k, q); lower triangle, a diagonal where none are correlated. Between positions
  // it is linear, and what a straight line misses. Beside them `shared`: parts that
  // other frames have too, by number.
  Eigen::Matrix<double, kBodyErrors, kBodyErrors> u_parts =
      Eigen::Matrix<double, kBodyErrors, kBodyErrors>::Zero();
  std::vector<std::array<double, kBodyErrors>> shared;
  // The same of the part that is independent from position to position of the axis.
  Eigen::Matrix<double, kBodyErrors, kBodyErrors> noise_parts =
      Eigen::Matrix<double, kBodyErrors, kBodyErrors>::Zero();
  std::array<bool, kBodyErrors> beyond{};  // as of TablePlace
};
FrameValues values_at(const MachineFrame& frame, const Command& command, MachineApproach approach);
std::vector<FrameValues> values_at(const Machine& machine, const Command& command,
                                   MachineApproach approach);

// A place that is less than this part of the last interval outside of a table is at its end, as far
// as a stop is at its target.
constexpr double kEndShare = 0.02;

// A command in a table of an error: the position below it, and the part of the way to the next.
struct TablePlace {
  std::size_t cell = 0;
  double part = 0;
  bool beyond = false;  // by more than kEndShare
};
TablePlace place_of(const std::vector<double>& position, double at);
// On the straight line between two values; of no values 0.
double value_at(const std::vector<double>& values, const TablePlace& place);

double command_of(const MachineFrame& frame, const Command& command);
// How far its body goes along + of its axis.
double travel_of(const MachineFrame& frame, const Command& command);

Pose nominal_pose(const MachineFrame& frame, double travel);
// The true displacement of the frame's body: the motion along the true line of the axis, then the
// body's errors at the point where they hold.
Pose actual_pose(const MachineFrame& frame, const FrameValues& values);
// That point when the body has travelled so far.
Eigen::Vector3d holding_point(const MachineFrame& frame, double travel);

}  // namespace mdof::algo
