// The machine's part in the error of a part: measured errors of its axes, and sources that were not
// measured, over the points of a path. SI.
#pragma once

#include <string>
#include <vector>

#include "algo/part/part_error.h"
#include "schema/machine/machine.h"

namespace mdof::algo {

struct MachineCauses {
  std::vector<PartCause> axes;    // of each error that is known: "EYX", "EC0Y"; of what axes share
  std::vector<PartCause> budget;  // of each source, on what is not measured
  std::vector<std::string> not_measured, no_u, beyond;  // as of ToolError
};

// Places of the path are those of the tool in the work's coordinates, from where it is when all
// commands are 0; the chain gives the commands (command_at_place()).
// `with_axes`: the measured errors count; else the sources act on these, too, as designed.
MachineCauses machine_causes(const Machine& machine, const std::vector<Eigen::Vector3d>& at_m,
                             bool with_axes = true);

}  // namespace mdof::algo
