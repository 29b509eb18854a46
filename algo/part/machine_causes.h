// Causes of the error of a part that are in the machine, over the points of a path: measured errors
// of its axes, and sources that were not measured. SI units.
#pragma once

#include <string>
#include <vector>

#include "algo/part/part_error.h"
#include "schema/machine/machine.h"

namespace mdof::algo {

struct MachineCauses {
  // One for each known error ("EYX", "EC0Y"), and for each quantity that axes share.
  std::vector<PartCause> axes;
  // One for each source: its effect on errors that were not measured.
  std::vector<PartCause> budget;
  std::vector<std::string> not_measured, no_u, beyond;  // same as in ToolError
};

// Points of the path are positions of the tool in workpiece coordinates, relative to its position
// when all commands are 0. The chain gives the commands (command_at_place()). `with_axes`: the
// measured errors count. Otherwise the sources act on these errors, too, as in a machine that is
// only designed.
MachineCauses machine_causes(const Machine& machine, const std::vector<Eigen::Vector3d>& at_m,
                             bool with_axes = true);

}  // namespace mdof::algo
