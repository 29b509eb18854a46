// Trends of figures as JSON, for the command line and run.trend.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "daemon/measure/several_runs/trends.h"
#include "schema/base/json_writer.h"

namespace mdof::daemon {

// "outside", "8 on one side" or empty: the signal of value i by the rules of the chart.
std::string trend_signal(const algo::Chart& chart, std::size_t i);

// The members of a figure's object, in the unit of the figure's name; limits are null if unknown.
void write_trend(JsonWriter& json, const Trend& trend);

std::string trends_json(const std::vector<Trend>& trends);

}  // namespace mdof::daemon
