// Volumetric tables as text and CSV.
#pragma once

#include <cstdint>
#include <string>

#include "schema/volumetric/volumetric_table.h"

namespace mdof::tools {

// `generation`: 0 if the table is not active.
std::string volumetric_text(const VolumetricTable& table, std::int64_t generation);
// One row for each node: X_mm, Y_mm, Z_mm, the corrections and their standard uncertainties.
std::string volumetric_csv(const VolumetricTable& table);

}  // namespace mdof::tools
