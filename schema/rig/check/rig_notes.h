// What every run of a rig says of it, so that a stored run says it as well.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace mdof {

// One sentence for each record of calibration that the rig refers to, and one for the corrections
// that it asks for. None for a text that is no rig.
std::vector<std::string> rig_notes(std::string_view rig_text);

}  // namespace mdof
