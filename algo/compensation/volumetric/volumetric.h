// A machine with its measured errors -> a table of corrections over a plane or a volume, and the
// table's value at a command.
#pragma once

#include <array>

#include "algo/compensation/table_limits.h"
#include "algo/machine/frames.h"
#include "schema/base/result.h"
#include "schema/volumetric/volumetric_table.h"

namespace mdof::algo {

struct VolumetricRequest {
  std::array<bool, 3> along{true, true, true};  // X, Y, Z: those of the grid
  double step_m = 0.01;                         // between two nodes, about
  Command others{};                             // where the other axes stand
  MachineApproach approach = MachineApproach::mean;
  // Also where an error that would count was not measured; the table names it.
  bool incomplete = false;
  TableLimits limits;
};

// The compensating command at each node (algo/machine/compensating.h), less the node. Id, runs,
// description and hash are the caller's.
// Errors: an axis that the chain has not or without range; more nodes than kMostVolumetricNodes, or
// kMostVolumetricCommands along an axis; an error that was not measured, unless `incomplete`; a
// node without compensating command; a correction beyond the limits.
inline constexpr std::size_t kMostVolumetricNodes = 100'000;
// Along an axis: they stand in every reply about the table, which has at most 48 KiB.
inline constexpr std::size_t kMostVolumetricCommands = 500;
Result<VolumetricTable> build_volumetric(const Machine& machine, const VolumetricRequest& request);

// Its corrections along each line of nodes. Error (bad_input): the line, and as of a series.
Status check_limits(const VolumetricTable& table, const TableLimits& limits);

// Of one command, X 0, over the nodes.
double largest_correction_m(const VolumetricTable& table, std::size_t axis);

struct VolumetricValue {
  Vec3 correction_m{}, u_m{};
  Vec3 u_common_m{}, u_independent_m{};  // parts of u_m; NaN: not known apart
  bool inside = true;                    // else the value of the nearest place of the grid
};
// Linear along each axis between the nodes. The common part of u is that of the nodes about it,
// and the deviation of straight lines at this place, taken as a parabola: 0 at a node, the largest
// deviation that was found in the middle between two. It counts in full: where it is reached, each
// measurement has it. The independent part is smaller than that of the nodes, since they are
// averaged (noise_variance()). Of an older table, whose noise is not known by axis, u is that of
// the nodes and the parts are NaN.
VolumetricValue volumetric_at(const VolumetricTable& table, const Vec3& command_m);

}  // namespace mdof::algo
