// A run as tables for people.
#pragma once

#include <string>
#include <vector>

#include "schema/run.h"
#include "schema/squareness.h"

namespace mdof::tools {

// "Simulated data: ..." with a line end, or nothing.
std::string simulated_notice(bool simulated);

std::string stated_text(const StatedAt& at);     // a line: where straightness is stated
std::string head_text(const RunHeader& header);  // identity, provenance, warnings
std::string points_text(const Run& run);         // five errors ± u, samples, flags
std::string straightness_text(const std::vector<StraightnessFigure>& figures);
std::string angles_text(const std::vector<AngleFigure>& figures);

std::string arrow(int direction);                 // "+", "-", "?"
std::string error_label(const std::string& key);  // "EYX_um" -> "EYX/µm"

}  // namespace mdof::tools
