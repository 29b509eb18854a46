// Whether the numbers of a rig can be those of a fixture: what a wrong unit makes of them (mm typed
// as µm, metres or volts) is found before anything is measured with it. What is impossible is an
// error; what is only odd, a warning.
#pragma once

#include <string>
#include <vector>

#include "schema/base/result.h"
#include "schema/notice/notice.h"
#include "schema/rig/rig.h"

namespace mdof {

// Error: the first impossible number, with file, line, key and the unit that was probably meant.
Status check_rig(const Rig& rig);

// The odd ones, each with file, line and key, for whoever measures with this rig.
Notices doubtful_values(const Rig& rig);

}  // namespace mdof
