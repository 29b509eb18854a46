// A control chart: one figure of the stored runs against the time of the runs, as an SVG document.
// Pure.
#pragma once

#include <string>

#include "daemon/measure/several_runs/trends.h"
#include "daemon/output/phrases.h"

namespace mdof::charts {

// The trend must have at least one value. The data-… attributes of each value are the value, its
// limits and its runs. The name of the figure ends in the unit of these numbers.
std::string control_chart_svg(const daemon::Trend& trend, output::Language language);

}  // namespace mdof::charts
