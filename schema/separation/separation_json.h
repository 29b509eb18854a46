// JSON of a separation.
#pragma once

#include <string>

#include "schema/separation/separation.h"

namespace mdof {

inline constexpr double kSeparationCoverage = 2;  // k of U, about 95 %

// {"method", "surface", "axis", "error", "set_ups": [...], "machine": {...}, "target": {...}, ...}
// In both series "seen_um" is what the readings determine, and "EYX_um" or "height_um" the same
// where no more than offset and slope is unseen, else null.
std::string separation_json(const SeparationRecord& record);

// What is in no u of a separation, for people.
const char* not_in_separation_u();

}  // namespace mdof
