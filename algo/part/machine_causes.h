// Calculates the effects of the machine on the error of a part at the points of a path. The causes
// are measured errors of the axes, and error sources that were not measured. SI units.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "algo/part/part_error.h"
#include "schema/machine/machine.h"

namespace mdof::algo {

struct MachineCauses {
  // One cause for each known error ("EYX", "EC0Y"), with its own u. Correlated errors have common
  // parts.
  std::vector<PartCause> axes;
  // One cause for each error source. It contains the effect of the source on errors that were not
  // measured.
  std::vector<PartCause> budget;
  std::vector<std::string> not_measured, no_u, beyond;  // same as in ToolError
  // Axes whose errors depend on the approach, with the number of points at which the path does not
  // give the approach, because the axis has not moved before. The mean of both approaches is used
  // there.
  std::vector<std::pair<std::string, std::size_t>> unknown_approach;
};

// `at_m`: path of the tool, as positions of the tool in workpiece coordinates, relative to the
// position of the tool when all commands are 0. command_at_place() calculates the commands from the
// chain. The errors of an axis are those of its last direction of motion on this path.
// `with_axes`: true: `budget` contains no effects on measured errors. false: `budget` contains the
// effects on all errors, as for a machine that is only designed.
MachineCauses machine_causes(const Machine& machine, const std::vector<Eigen::Vector3d>& at_m,
                             bool with_axes = true);

}  // namespace mdof::algo
