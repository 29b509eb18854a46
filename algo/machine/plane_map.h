// Errors of the tool over a plane of two axes.
#pragma once

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct PlanePoint {
  double first_m = 0, second_m = 0;  // commands of the two axes
  Eigen::Vector3d error, u;          // of the tool's place, m; u: NaN where nothing has one
};
struct PlaneMap {
  std::size_t first = 0, second = 1;  // directions of the two axes
  std::vector<double> first_m, second_m;
  std::vector<PlanePoint> points;                       // the first axis runs fastest
  std::vector<std::string> not_measured, no_u, beyond;  // of the components shown, anywhere
};

// Of the command that is used: range of the description, else what the tables of the axis have in
// common. Error: neither.
Result<std::array<double, 2>> range_of(const MachineFrame& frame);

// From end to end in equal steps of about step_m, at least one.
std::vector<double> steps_over(const std::array<double, 2>& range, double step_m);

struct PlaneMapRequest {
  std::size_t first = 0, second = 1;
  double step_m = 0.01;
  Command others{};  // where the other axes stand
  MachineApproach approach = MachineApproach::mean;
  bool without_angles = false;  // positions, straightness and squareness alone (Eq. 1 of Hwang)
};
// As tool_error() at each point, to rounding (1e-16 m; u to 1e-9 of its largest), in a time that
// hardly depends on the chain (grid_chain.h).
// Error: an axis that the chain has not; no range; a million points or more.
Result<PlaneMap> plane_map(const Machine& machine, const PlaneMapRequest& request);

// The error of the largest size of each component, with its sign, and the range of it (largest less
// smallest).
struct MapExtreme {
  std::size_t point = 0;
  double value = 0, range = 0;
};
std::array<MapExtreme, 3> extremes_of(const PlaneMap& map);

// Without the errors that turn a body; squareness stays.
Machine without_angles(Machine machine);

}  // namespace mdof::algo
