// The squareness of X and Y as one line for controllers that shear their commands.
//
// The angle from +X to +Y is 90 deg + EC0Y: if the tool moves by y along Y, its error along X is -y
// tan EC0Y. The correction moves X to x + k y with k = tan EC0Y, or k = -tan EC0Y if one of the two
// commands moves the tool towards - (schema/rig/correction.h gives the sign s of each axis: k = s_X
// s_Y tan EC0Y).
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Error (bad_input): the machine's chain is unknown, or lacks X or Y.
Result<double> shear_of(const SquareAxes& axes);

// SET_SKEW XY=AC,BD,AD: the diagonals and one side of a square of 100 mm as the machine would draw
// it.
Result<Export> write_klipper(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_klipper(const std::vector<ControllerFile>& files);

// M852 I: X moves to x - I y.
Result<Export> write_marlin(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_marlin(const std::vector<ControllerFile>& files);

// M556 S100 X: X / S is the tangent of the angle above 90 deg.
Result<Export> write_reprapfirmware(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_reprapfirmware(const std::vector<ControllerFile>& files);

// setp matrixkins.C_xy: joint X = x + C_xy y.
Result<Export> write_matrixkins(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_matrixkins(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
