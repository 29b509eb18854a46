// JSON of a separation.
#pragma once

#include <string>

#include "schema/separation/separation.h"

namespace mdof {

// Returns {"method", "surface", "axis", "error", "set_ups": [...], "machine": {...}, "target":
// {...}, ...}. "machine" and "target" are series. In each series, "seen_um" is the part that the
// readings determine. If at most offset and slope are undetermined, "EYX_um" or "height_um" has the
// same value as "seen_um"; otherwise it is null. Each position has "k" and "nu_eff" (null:
// infinite). The object also has "k" and "nu_eff"; they are null if the positions have different
// values. If u is unknown, U, k and nu_eff are null, and "u_from" states the reason.
std::string separation_json(const SeparationRecord& record);

// Text for people: the contributions that u of a separation does not include.
const char* separation_u_omits();

}  // namespace mdof
