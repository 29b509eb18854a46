// Self-test of an export. The test reads the files in the same way as the controller, applies the
// corrections to a simulated axis with the errors of the table, and checks that the remaining
// errors are below a limit.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/controllers/export.h"
#include "schema/sample.h"

namespace mdof::controllers {

// The result of the same test with a deliberate mistake in the correction. The test must detect the
// mistake.
struct Control {
  std::string name;        // "wrong sign", "forward and reverse swapped"
  double residual = 0;     // m or rad
  bool detected = false;   // the residual exceeds the bound
  bool too_small = false;  // the mistake has almost no effect, so the test cannot detect it
};

struct CheckedError {
  std::string error;  // "EXX"; for a volumetric table the corrected command, "X"
  bool angle = false;
  // The test uses the mean error of both approaches, or the error in `approach`, because of
  // ExportOptions::one_approach.
  bool one_way = false;
  // "forward" or "reverse": a volumetric table with the values of this approach only, so that
  // by_reversal remains in the other approach. Empty: other tables.
  std::string approach;
  double before = 0;  // largest error without the correction, m or rad
  // Largest error with the correction, over both approaches, at the points and between them.
  double residual = 0;
  // Errors that the file cannot correct, m or rad.
  // - by_reversal: the error that remains in each approach if the file has one value for both
  //   approaches. It is part of `residual`, unless one_way is true.
  // - between_nodes: the error between the nodes of a volumetric table. It is part of `residual`.
  double by_reversal = 0, between_nodes = 0;
  // Largest error at the measured positions beyond the ends of the file, where the controller uses
  // the values at the ends; m or rad. It is not part of `residual`. NaN: there are no such
  // positions.
  double outside = kNaN;
  // The error after a reversal whose correction LinuxCNC does not apply, because the ramp of
  // LinuxCNC does not start (ExportOptions::ramps), m or rad. This error is also part of
  // `residual`.
  double error_by_ramp = 0;
  // Limit of `residual`. For tables of axes it is the sum of the following terms, but at most the
  // limit in ExportOptions:
  // - the deviation that omitted points cause
  // - the resolution of the numbers in the file
  // - the second-order effect: a correction changes the position at which the error acts
  // - error_by_ramp
  // - by_reversal, unless one_way is true
  // For volumetric tables and the squareness it is the limit in ExportOptions.
  double bound = 0;
  bool cancels = false;
  // The error without correction is below the resolution of the numbers in the file.
  bool nothing = false;
  std::vector<Control> controls;
};

struct Check {
  std::vector<CheckedError> errors;
  std::vector<std::string> not_judged;  // written errors whose correction sign is unknown
  // Limits from ExportOptions. For tables of axes, most_residual_m includes tolerance_m.
  double most_residual_m = 0, share = 0;
  bool passed() const;  // whether all errors with a known sign pass
  // Whether all errors are below the resolution of the numbers in the file.
  bool nothing_to_correct() const;
};

// Checks the files that `format` wrote for these tables. The simulated axis has the errors of the
// tables, interpolated linearly. Errors: the controller would misread a file; a file corrects an
// error that no table contains.
Result<Check> check_export(const Format& format, const std::vector<CompensationTable>& tables,
                           const Export& exported, const ExportOptions& options);
// The same for a volumetric table: checks the nodes and the centres of the cells.
// CheckedError::error is the corrected command.
Result<Check> check_export(const Format& format, const VolumetricTable& table,
                           const Export& exported, const ExportOptions& options);
// The same for the squareness: checks the deviation of the tool from the perpendicular to X while Y
// moves.
Result<Check> check_export(const Format& format, const SquareAxes& axes, const Export& exported,
                           const ExportOptions& options);

}  // namespace mdof::controllers
