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

// ---- what files of a volumetric table have in common ----

// What a reader of the file has to know beside its numbers; without comment signs.
std::vector<std::string> head_of(const VolumetricTable& table, const ExportOptions& options,
                                 const std::string& sense);
// What of the options has no effect.
void note_options(const ExportOptions& options, Export& out);
void count_nodes(const VolumetricTable& table, Export& out);
// X, Y, Z of more than one command.
std::vector<std::size_t> axes_of_grid(const VolumetricTable& table);
// m. Error (bad_input): steps that are not equal, which `controller` needs.
Result<double> equal_step(const VolumetricTable& table, std::size_t axis,
                          const std::string& controller);

}  // namespace mdof::controllers
