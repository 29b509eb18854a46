// Self-test of an export: reads the files back by the rules of the controller, applies them to a
// simulated axis with the errors of the table, and checks that the errors vanish.
#pragma once

#include <string>
#include <vector>

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// The same test with a deliberate mistake, which it must detect.
struct Control {
  std::string name;        // "wrong sign", "forward and reverse swapped"
  double residual = 0;     // m or rad
  bool detected = false;   // the residual exceeds the bound
  bool too_small = false;  // the mistake changes less than the bound, so it cannot be detected
};

struct CheckedError {
  std::string error;  // "EXX"; the command, "X", for a volumetric table
  bool angle = false;
  bool one_way = false;  // the mean of both approaches is judged: ExportOptions::one_approach
  double before = 0;     // largest error without the correction, m or rad
  double residual = 0;   // largest error with the correction, both approaches, at and between the
                         // points
  // Parts of the residual that the file cannot correct. by_reversal: the error in each
  // approach if one value corrects errors that differ by approach (not part of the residual if the
  // mean is judged). between_nodes: the error between the nodes of a volumetric table.
  double by_reversal = 0, between_nodes = 0;
  // Also part of the residual: the error after a reversal, because the ramp of the controller does
  // not start (LinuxCNC; ExportOptions::ramps).
  double by_ramp = 0;
  // Limit of the residual: thinning, the step of the numbers, second order, by_ramp and (unless the
  // mean is judged) by_reversal; at most the limit of ExportOptions. For volumetric tables and the
  // squareness only the limit of ExportOptions.
  double bound = 0;
  bool cancels = false;
  bool nothing = false;  // no error exceeds a step of the numbers
  std::vector<Control> controls;
};

struct Check {
  std::vector<CheckedError> errors;
  std::vector<std::string> not_judged;    // written, but the sign of the correction is unknown
  double most_residual_m = 0, share = 0;  // limits from ExportOptions, including the tolerance
  bool passed() const;                    // whether all errors that could be judged pass
  bool nothing_to_correct() const;        // no error exceeds a step of the numbers
};

// Checks the files that `format` wrote for these tables. Each error is that of the table, linear
// between its points. Errors: files that the controller would misread; a correction of an error
// that no table has.
Result<Check> check_export(const Format& format, const std::vector<CompensationTable>& tables,
                           const Export& exported, const ExportOptions& options);
// The same for a volumetric table: at its nodes and in the middle of their cells. `error` is the
// corrected command.
Result<Check> check_export(const Format& format, const VolumetricTable& table,
                           const Export& exported, const ExportOptions& options);
// The same for the squareness: by how much the tool deviates from the perpendicular to X while Y
// moves.
Result<Check> check_export(const Format& format, const SquareAxes& axes, const Export& exported,
                           const ExportOptions& options);

}  // namespace mdof::controllers
