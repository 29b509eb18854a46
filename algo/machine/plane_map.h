// Errors of the tool over a plane of two axes.
#pragma once

#include <array>
#include <cmath>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct PlanePoint {
  Eigen::Vector3d error, u;  // of the tool's place, m; u is NaN if no error has a declared u
};

// Value of largest magnitude of one component of the error, with its sign, its u and the number of
// its point. `range` is the largest minus the smallest value of the component.
struct MapExtreme {
  std::size_t point = 0;
  double value = 0, u = 0, range = 0;
};
// Finds the extremes of x, y and z over all points that are added.
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
  std::size_t first = 0, second = 1;  // the two axes: 0 X, 1 Y, 2 Z
  std::vector<double> first_m, second_m;
  std::vector<PlanePoint> points;  // the first axis varies fastest; empty if extremes_only
  std::array<MapExtreme, 3> extremes;
  std::vector<std::string> not_measured, no_u, beyond;  // names of errors, as in ToolError, for x,
                                                        // y and z at any point

  // Command of each axis at a point.
  double first_at(std::size_t point) const { return first_m[point % first_m.size()]; }
  double second_at(std::size_t point) const { return second_m[point / first_m.size()]; }
};

// Range of the command of the axis: the range in the machine file, or otherwise the common range of
// the error tables of the axis. Error: the axis has neither.
Result<std::array<double, 2>> range_of(const MachineFrame& frame);

// Positions over the whole range, in one or more equal steps of about step_m.
std::vector<double> steps_over(const std::array<double, 2>& range, double step_m);

struct PlaneMapRequest {
  std::size_t first = 0, second = 1;
  double step_m = 0.01;
  Command others{};  // commands of the other axes
  MachineApproach approach = MachineApproach::mean;
  // Use only position errors, straightness and squareness (Eq. 1 of Hwang).
  bool without_angles = false;
  bool extremes_only = false;  // does not store the points
};
// Calculates error and u at each point as tool_error() does, but faster (grid_chain.h). The
// rounding is 1e-16 m for the error, and 1e-9 of the largest u for u. Errors: an axis that the
// chain does not have; an axis without a range; a million points or more.
Result<PlaneMap> plane_map(const Machine& machine, const PlaneMapRequest& request);

// Sets the angle errors of all bodies to 0. Keeps the squareness errors.
Machine without_angles(Machine machine);

}  // namespace mdof::algo
