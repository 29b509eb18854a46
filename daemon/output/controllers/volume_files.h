// File formats of controllers that correct X, Y and Z by a grid of corrections.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// ISG's tabular format, which TF5280 reads, and the list file that names the table file. The file
// states the corrections as the errors EXX, EYX, EZX of one axis, as functions of the positions of
// all axes of the grid. The file contains no angles and declares all axes on the side of the tool.
// Under these conditions the controller adds exactly the values of the table, for every chain of
// the machine.
Result<Export> write_isg_csv(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_isg_csv(const std::vector<ControllerFile>& files);

// The geometric correction table of KMotion (Dynomotion). Its rows are along Y, its columns along
// X, and its values are in inches. Errors (bad_input): the grid has other axes than X and Y; its
// steps are unequal.
Result<Export> write_dynomotion(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_dynomotion(const std::vector<ControllerFile>& files);

// ---- functions that several formats of volumetric tables use ----

// The lines of the comment at the beginning of a file, without comment signs.
std::vector<std::string> head_of(const VolumetricTable& table, const ExportOptions& options,
                                 const std::string& sense);
// Adds notes to `out` on options that have no effect for a volumetric table.
void note_options(const ExportOptions& options, Export& out);
void count_nodes(const VolumetricTable& table, Export& out);
// The axes (0, 1, 2 for X, Y, Z) that have more than one node.
std::vector<std::size_t> grid_axes(const VolumetricTable& table);
// The step along an axis, m. Error (bad_input): the steps are unequal, which `controller` does not
// support.
Result<double> equal_step(const VolumetricTable& table, std::size_t axis,
                          const std::string& controller);

}  // namespace mdof::controllers
