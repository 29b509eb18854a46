// Trends of figures as JSON, for the command line and run.trend.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/measure/several_runs/trends.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {

// The signal of value i according to the rules of the control chart: "outside", "8 on one side" or
// "" (no signal).
std::string trend_signal(const algo::Chart& chart, std::size_t i);

// Writes the members of the trend of one figure. The unit is in the name of the figure. Unknown
// limits are null.
void write_trend(JsonWriter& json, const Trend& trend);

std::string trends_json(const std::vector<Trend>& trends);

}  // namespace mdof::daemon
