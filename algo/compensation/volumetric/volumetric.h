// Builds a table of corrections over a plane or a volume from a machine with its measured errors,
// and evaluates the table at a command.
#pragma once

#include <array>

#include "algo/compensation/table_limits.h"
#include "algo/machine/frames.h"
#include "schema/base/result.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

struct VolumetricRequest {
  std::array<bool, 3> along{true, true, true};  // true: the grid extends along X, Y, Z
  double step_m = 0.01;                         // approximate distance between nodes
  Command others{};                             // commands of the axes that are not in the grid
  MachineApproach approach = MachineApproach::mean;
  // true: builds the table even if a relevant error was not measured; the table states this error.
  bool incomplete = false;
  TableLimits limits;
};

// The correction at a node is the compensating command (algo/machine/compensating.h) minus the
// command of the node. The caller sets id, runs, description and hash of the table. Errors:
// - an axis that the chain does not have, or that has no range
// - more nodes than kMostVolumetricNodes, or more nodes along an axis than kMostVolumetricCommands
// - a relevant error that was not measured, unless `incomplete`
// - a node without compensating command
// - a correction beyond the limits
inline constexpr std::size_t kMostVolumetricNodes = 100'000;
// Largest number of nodes along an axis. Each reply about the table contains the commands of all
// nodes along the axes and must not exceed 48 KiB.
inline constexpr std::size_t kMostVolumetricCommands = 500;
Result<VolumetricTable> build_volumetric(const Machine& machine, const VolumetricRequest& request);

// Checks the corrections along each line of nodes that is parallel to an axis. The error
// (bad_input) is the error of check_limits() for a series, with the line.
Status check_limits(const VolumetricTable& table, const TableLimits& limits);

// Returns the largest absolute correction of one axis over all nodes; axis 0 is X.
double largest_correction_m(const VolumetricTable& table, std::size_t axis);

// Returns the largest u of the correction of one axis at the nodes and in the middle of all edges,
// faces and cells; NaN if u is unknown at one of these places.
double largest_u_m(const VolumetricTable& table, std::size_t axis);

struct VolumetricValue {
  Vec3 correction_m{}, u_m{};
  Vec3 u_common_m{}, u_independent_m{};  // parts of u_m; NaN: parts unknown
  bool inside = true;                    // false: the values are from the nearest point of the grid
};
// Interpolates linearly along each axis between the nodes.
// - The common part of u combines the u of the surrounding nodes, the interpolation error at this
//   point and, along each axis, u_between_m of the cell, which is a parabola like the interpolation
//   error. Along the axes, the interpolation error is a parabola: 0 at a node and, in the
//   middle between two nodes, the largest deviation that was found. The deviation counts as a
//   standard uncertainty without a divisor, because each measurement at the point of the largest
//   deviation has this deviation.
// - The independent part is smaller than at the nodes, because interpolation averages the noise of
//   the nodes (noise_variance()).
// - Tables of older versions do not contain the noise of each axis. For these tables, u is
//   interpolated from the u of the nodes, and both parts are NaN.
VolumetricValue volumetric_at(const VolumetricTable& table, const Vec3& command_m);

}  // namespace mdof::algo
