// Volumetric tables as CSV and text for people.
#pragma once

#include <cstdint>
#include <string>

#include "schema/volumetric/volumetric_table.h"

namespace mdof::tools {

// `generation`: 0 where the table is not active.
std::string volumetric_text(const VolumetricTable& table, std::int64_t generation);
// A row a node: X_mm, Y_mm, Z_mm, corrections and their u.
std::string volumetric_csv(const VolumetricTable& table);

}  // namespace mdof::tools
