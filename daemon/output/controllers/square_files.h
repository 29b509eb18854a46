// The squareness of X and Y as one line, for controllers that add a share of the command y to the
// command x.
//
// The angle from +X to +Y is 90 deg + EC0Y: if the tool moves by y along Y, its error along X is -y
// tan EC0Y. The correction moves X to x + k y with k = tan EC0Y, or k = -tan EC0Y if a positive
// command of exactly one of the two axes moves the tool in the negative direction. In general k =
// s_X s_Y tan EC0Y, with the sign s of each axis from schema/rig/correction.h.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// Error (bad_input): the chain of the machine is unknown, or contains no axis X or no axis Y.
Result<double> shear_of(const SquareAxes& axes);

// SET_SKEW XY=AC,BD,AD: the lengths of both diagonals and of one side. The machine without
// correction would draw this figure for a square of 100 mm.
Result<Export> write_klipper(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_klipper(const std::vector<ControllerFile>& files);

// Marlin: with M852 I the controller moves X to x - I y.
Result<Export> write_marlin(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_marlin(const std::vector<ControllerFile>& files);

// RepRapFirmware: in M556 S100 X..., X / S is tan(angle between the axes - 90 deg).
Result<Export> write_reprapfirmware(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_reprapfirmware(const std::vector<ControllerFile>& files);

// LinuxCNC's matrixkins: with setp matrixkins.C_xy the controller moves the joint X to x + C_xy y.
Result<Export> write_matrixkins(const SquareAxes& axes, const ExportOptions& options);
Result<double> read_matrixkins(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
