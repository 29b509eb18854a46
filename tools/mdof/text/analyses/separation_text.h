// A separation for people, as CSV, and as the [[plane]] of a rig.
#pragma once

#include <cstddef>
#include <string>

#include "schema/separation/separation.h"

namespace mdof::tools {

std::string separation_text(const SeparationRecord& record, std::size_t width);

// series ("machine" or "target"), place_mm, seen_um, u_um, U_um, whole (1: no more than offset and
// slope is unseen).
std::string separation_csv(const SeparationRecord& record);

// The target's height as [[plane]] flatness_... of a rig, with comments that say when and from what
// it was made and what is not in it.
std::string separation_plane_toml(const SeparationRecord& record);

// "offset, slope and 2 of period 10 mm"
std::string unseen_text(const SeenSeries& series);

}  // namespace mdof::tools
