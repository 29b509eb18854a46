// JSON of a separation.
#pragma once

#include <string>

#include "schema/separation/separation.h"

namespace mdof {

// {"method", "surface", "axis", "error", "set_ups": [...], "machine": {...}, "target": {...}, ...}
// In both series "seen_um" is what the readings determine, and "EYX_um" or "height_um" the same
// where no more than offset and slope is unseen, else null. "k" and "nu_eff" (null: infinite) of
// each place; beside them those that all places have, else null. Where u is not known, U, k and
// nu_eff are null, and "u_from" says why.
std::string separation_json(const SeparationRecord& record);

// What is in no u of a separation, for people.
const char* not_in_separation_u();

}  // namespace mdof
