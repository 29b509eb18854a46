// The squareness of X and Y as one line of controllers that shear their commands.
//
// The angle from +X to +Y is 90 deg + EC0Y: while the tool goes along Y by y it is off along X by
// -y tan EC0Y. So X is to move to x + k y with k = tan EC0Y; -tan EC0Y where one of both commands
// moves the tool along - (schema/rig/correction.h has the sign s of each axis: k = s_X s_Y tan
// EC0Y).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Error (bad_input): the machine's chain is not known, or lacks X or Y.
Result<double> shear_of(const SquareAxes& axes);

// SET_SKEW XY=AC,BD,AD: the diagonals and a side of a square of 100 mm that the machine would draw.
Result<Export> write_klipper(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_klipper(const std::vector<ControllerFile>& files);

// M852 I: X moves to x - I y.
Result<Export> write_marlin(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_marlin(const std::vector<ControllerFile>& files);

// M556 S100 X: X / S is the tangent by which the angle is above 90 deg.
Result<Export> write_reprapfirmware(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_reprapfirmware(const std::vector<ControllerFile>& files);

// setp matrixkins.C_xy: joint X = x + C_xy y.
Result<Export> write_matrixkins(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_matrixkins(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
