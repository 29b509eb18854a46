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
  std::array<bool, 3> along{true, true, true};  // axes X, Y, Z of the grid
  double step_m = 0.01;                         // approximate distance between nodes
  Command others{};                             // positions of the other axes
  MachineApproach approach = MachineApproach::mean;
  // Build the table even if a relevant error was not measured; the table names this error.
  bool incomplete = false;
  TableLimits limits;
};

// The compensating command at each node (algo/machine/compensating.h) minus the node. The caller
// sets id, runs, description and hash. Errors: an axis that the chain does not have or that has no
// range; more nodes than kMostVolumetricNodes, or than kMostVolumetricCommands along an axis; an
// error that was not measured, unless `incomplete`; a node without compensating command; a
// correction beyond the limits.
inline constexpr std::size_t kMostVolumetricNodes = 100'000;
// Along an axis. Each reply about the table contains these commands and has at most 48 KiB.
inline constexpr std::size_t kMostVolumetricCommands = 500;
Result<VolumetricTable> build_volumetric(const Machine& machine, const VolumetricRequest& request);

// Checks the corrections along each line of nodes. Error (bad_input): as of a series, with the
// line.
Status check_limits(const VolumetricTable& table, const TableLimits& limits);

// Largest correction of one command over the nodes; axis 0 is X.
double largest_correction_m(const VolumetricTable& table, std::size_t axis);

struct VolumetricValue {
  Vec3 correction_m{}, u_m{};
  Vec3 u_common_m{}, u_independent_m{};  // parts of u_m; NaN: parts unknown
  bool inside = true;                    // false: the value of the nearest point of the grid
};
// Interpolates linearly along each axis between the nodes. The common part of u is the u of the
// surrounding nodes combined with the interpolation error at this point. That error is taken as a
// parabola: 0 at a node, and the largest deviation that was found in the middle between two nodes.
// It is not reduced to a standard uncertainty, because each measurement at the point of the largest
// deviation has this deviation. The independent part is smaller than at the nodes, because
// interpolation averages them (noise_variance()). In tables of older versions without noise by
// axis, u is the u of the nodes and the parts are NaN.
VolumetricValue volumetric_at(const VolumetricTable& table, const Vec3& command_m);

}  // namespace mdof::algo
