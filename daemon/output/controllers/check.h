// Does what was exported make the error vanish? The files are read back by the controller's own
// rules and applied to a simulated axis that has the table's errors.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// The same with a mistake planted: the check is worth something only if it is seen.
struct Control {
  std::string name;        // "wrong sign", "forward and reverse swapped"
  double residual = 0;     // m or rad
  bool detected = false;   // beyond the bound
  bool too_small = false;  // the mistake would change less than the bound: it cannot be seen
};

struct CheckedError {
  std::string error;  // "EXX"; of a volumetric table the command, "X"
  bool angle = false;
  bool one_way = false;  // judged is the mean of both approaches: ExportOptions::one_approach
  double before = 0;     // largest error without the correction, m or rad
  double residual = 0;   // with it, both approaches, on the grid and between
  // Parts of the residual that the file cannot correct: of one value for errors that differ by
  // approach, in each of them (where the mean is judged, beside the residual); between the nodes of
  // a volumetric table.
  double by_reversal = 0, between_nodes = 0;
  // In the residual, too: what stays after a turn, because the ramp of the controller does not
  // start (LinuxCNC; ExportOptions::ramps).
  double by_ramp = 0;
  // Thinning, step of the numbers and second order; at most what ExportOptions allows.
  double bound = 0;
  bool cancels = false;
  bool nothing = false;  // there is no error above a step of the numbers
  std::vector<Control> controls;
};

struct Check {
  std::vector<CheckedError> errors;
  std::vector<std::string> not_judged;    // written, but nobody knows which way its correction goes
  double most_residual_m = 0, share = 0;  // as of ExportOptions, the tolerance in it
  bool passed() const;                    // of what could be judged
  bool nothing_to_correct() const;        // no error is above a step of the numbers
};

// Of what `format` wrote of these tables. Each error is the table's own, joined by straight lines.
// Errors: files that the controller would not read as meant; a correction of an error that no table
// has.
Result<Check> check_export(const Format& format, const std::vector<CompensationTable>& tables,
                           const Export& exported, const ExportOptions& options);
// The same of a volumetric table: at its nodes and in the middle of their cells. `error` is the
// command that is corrected.
Result<Check> check_export(const Format& format, const VolumetricTable& table,
                           const Export& exported, const ExportOptions& options);
// The same of the squareness: how far the tool leaves the perpendicular of X as Y is commanded.
Result<Check> check_export(const Format& format, const SquareAxes& axes, const Export& exported,
                           const ExportOptions& options);

}  // namespace mdof::controllers
