// A control chart of a figure of the stored runs over time, as an SVG document. Pure.
#pragma once

#include <string>

#include "daemon/measure/several_runs/trends.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// The trend must have at least one value. Each value has its number, limits and runs as data-…
// attributes, in the unit of the figure's name.
std::string control_chart_svg(const daemon::Trend& trend, output::Language language);

}  // namespace mdof::charts
