// Checks whether the numbers of a rig are plausible. It finds wrong units (values in mm, m or V
// instead of µm) before a measurement. An impossible number causes an error, an unusual number a
// notice.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof {

// Error: the first impossible number. The message contains file, line, key and the unit that the
// user probably meant.
Status check_rig(const Rig& rig);

// Notices for unusual numbers, each with file, line and key.
Notices unusual_values(const Rig& rig);

}  // namespace mdof
