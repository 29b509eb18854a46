// JSON of a separation.
#pragma once

#include <string>

#include "schema/separation/separation.h"

namespace mdof {

// {"method", "surface", "axis", "error", "set_ups": [...], "machine": {...}, "target": {...}, ...}
// In both series "seen_um" is the part that the readings determine. "EYX_um" or "height_um" has the
// same value if at most offset and slope are undetermined, otherwise null. Each place has "k" and
// "nu_eff" (null: infinite); outside the series they are present if all places have the same value,
// otherwise null. If u is unknown, U, k and nu_eff are null, and "u_from" states why.
std::string separation_json(const SeparationRecord& record);

// Contributions that u of a separation does not include, for people.
const char* separation_u_omits();

}  // namespace mdof
