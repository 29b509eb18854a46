// Volumetric tables as files of controllers that correct X, Y and Z by a grid.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// ISG's tabular format, as TF5280 reads it, and the list file that names it. The corrections are
// written as the errors EXX, EYX, EZX of one axis by the position of all axes of the grid. Without
// angles, and all axes on the side of the tool, these are the errors of the tool whatever the
// machine's chain is; so the controller adds what the table holds.
Result<Export> write_isg_csv(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_isg_csv(const std::vector<ControllerFile>& files);

// KMotion's geometric correction: rows along Y, columns along X, in inches. Error (bad_input): a
// grid that is not of X and Y alone, or whose steps are not equal.
Result<Export> write_dynomotion(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_dynomotion(const std::vector<ControllerFile>& files);

}  // namespace mdof::controllers
