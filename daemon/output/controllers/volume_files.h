// Volumetric tables as files of controllers that correct X, Y and Z with a grid.
#pragma once

#include "daemon/output/controllers/export.h"

namespace mdof::controllers {

// ISG's tabular format, as TF5280 reads it, and the list file that names it. The corrections are
// written as the errors EXX, EYX, EZX of one axis by the position of all axes of the grid. Without
// angles, and with all axes on the side of the tool, these are the errors of the tool for every
// chain of the machine, so that the controller adds the values of the table.
Result<Export> write_isg_csv(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_isg_csv(const std::vector<ControllerFile>& files);

// KMotion's geometric correction: rows along Y, columns along X, in inches. Error (bad_input): a
// grid with other axes than X and Y, or unequal steps.
Result<Export> write_dynomotion(const VolumetricTable& table, const ExportOptions& options);
Result<VolumetricTable> read_dynomotion(const std::vector<ControllerFile>& files);

// ---- common parts of the files of a volumetric table ----

// Information for readers of the file besides its numbers; without comment signs.
std::vector<std::string> head_of(const VolumetricTable& table, const ExportOptions& options,
                                 const std::string& sense);
// Notes on options without an effect.
void note_options(const ExportOptions& options, Export& out);
void count_nodes(const VolumetricTable& table, Export& out);
// Those of X, Y, Z that have more than one command.
std::vector<std::size_t> grid_axes(const VolumetricTable& table);
// In m. Error (bad_input): unequal steps, which `controller` does not support.
Result<double> equal_step(const VolumetricTable& table, std::size_t axis,
                          const std::string& controller);

}  // namespace mdof::controllers
