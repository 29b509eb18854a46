// A separation as text, as CSV, and as a [[plane]] for a rig file.
#pragma once

#include <cstddef>
#include <string>

#include "schema/separation/separation.h"

namespace mdof::tools {

std::string separation_text(const SeparationRecord& record, std::size_t width);

// Columns: series ("machine" or "target"), place_mm, seen_um, u_um, U_um, whole (1: at most offset
// and slope are undetermined).
std::string separation_csv(const SeparationRecord& record);

// The height of the target as the keys flatness_... of a [[plane]] in a rig file. Comments in the
// text state the date, the sources, and what is not included.
std::string separation_plane_toml(const SeparationRecord& record);

// A text with the undetermined components: "offset, slope and 2 of period 10 mm".
std::string undetermined_text(const DeterminedSeries& series);

}  // namespace mdof::tools
