// Errors of the tool over a plane of two axes.
#pragma once

#include <array>
#include <cmath>

#include "algo/machine/tool_error.h"

namespace mdof::algo {

struct PlanePoint {
  Eigen::Vector3d error, u;  // of the tool's place, m; u: NaN where nothing has one
};

// The error of the largest size of a component, with its sign and its u, and the range of it
// (largest less smallest).
struct MapExtreme {
  std::size_t point = 0;
  double value = 0, u = 0, range = 0;
};
// Of points that are added one after the other: x, y, z.
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
  std::vector<PlanePoint> points;  // the first axis runs fastest; with extremes_only none
  std::array<MapExtreme, 3> extremes;
  std::vector<std::string> not_measured, no_u, beyond;  // of the components shown, anywhere

  // Commands of the two axes at a point.
  double first_at(std::size_t point) const { return first_m[point % first_m.size()]; }
  double second_at(std::size_t point) const { return second_m[point / first_m.size()]; }
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
  bool extremes_only = false;   // a million points take longer to keep than to find
};
// As tool_error() at each point, to rounding (1e-16 m; u to 1e-9 of its largest), in a time that
// hardly depends on the chain (grid_chain.h).
// Error: an axis that the chain has not; no range; a million points or more.
Result<PlaneMap> plane_map(const Machine& machine, const PlaneMapRequest& request);

// Without the errors that turn a body; squareness stays.
Machine without_angles(Machine machine);

}  // namespace mdof::algo
