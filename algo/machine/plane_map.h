// Errors of the tool over a plane of two axes.
#pragma once

#include <array>
#include <cmath>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct PlanePoint {
  Eigen::Vector3d error, u;  // at the tool's place, m; u: NaN if no error has one
};

// The largest magnitude of a component of the error, with its sign and its u, and the range of the
// component (largest minus smallest).
struct MapExtreme {
  std::size_t point = 0;
  double value = 0, u = 0, range = 0;
};
// Extremes of x, y, z over points that are added one after the other.
class MapExtremes {
 public:
  void add(const PlanePoint& point);
  std::array<MapExtreme, 3> found() const;

 private:
  struct Ends {
    MapExtreme lowest{0, INFINITY, 0, 0}, highest{0, -INFINITY, 0, 0};
  };
  std::array<Ends, 3> ends_;
  std::size_t points_ = 0;
};

struct PlaneMap {
  std::size_t first = 0, second = 1;  // directions of the two axes
  std::vector<double> first_m, second_m;
  std::vector<PlanePoint> points;  // the first axis varies fastest; empty with extremes_only
  std::array<MapExtreme, 3> extremes;
  std::vector<std::string> not_measured, no_u, beyond;  // for the shown components, at any point

  // Command of each axis at a point.
  double first_at(std::size_t point) const { return first_m[point % first_m.size()]; }
  double second_at(std::size_t point) const { return second_m[point / first_m.size()]; }
};

// Range of the axis' command: the range in the description, otherwise the common range of the axis'
// tables. Error: neither is given.
Result<std::array<double, 2>> range_of(const MachineFrame& frame);

// Positions from end to end, in equal steps of about step_m, at least one step.
std::vector<double> steps_over(const std::array<double, 2>& range, double step_m);

struct PlaneMapRequest {
  std::size_t first = 0, second = 1;
  double step_m = 0.01;
  Command others{};  // commands of the other axes
  MachineApproach approach = MachineApproach::mean;
  bool without_angles = false;  // only positions, straightness and squareness (Eq. 1 of Hwang)
  bool extremes_only = false;   // storing a million points takes longer than calculating them
};
// As tool_error() at each point, to rounding (1e-16 m; u to 1e-9 of its largest value), in a time
// that hardly depends on the chain (grid_chain.h). Error: an axis that the chain does not have; no
// range; a million points or more.
Result<PlaneMap> plane_map(const Machine& machine, const PlaneMapRequest& request);

// Removes the errors that turn a body; squareness is kept.
Machine without_angles(Machine machine);

}  // namespace mdof::algo
