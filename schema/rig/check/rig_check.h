// Checks whether the numbers of a rig are plausible, to find wrong units (mm entered as µm, metres
// or volts) before a measurement. An impossible number is an error, an unusual one a notice.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof {

// Error: the first impossible number, with file, line, key and the unit that was probably meant.
Status check_rig(const Rig& rig);

// Unusual numbers, each with file, line and key, for the user of this rig.
Notices unusual_values(const Rig& rig);

}  // namespace mdof
