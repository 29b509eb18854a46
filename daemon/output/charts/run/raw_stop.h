// Draws the recorded raw readings around one stop, and marks the readings that were averaged. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "schema/sample.h"

namespace mdof::charts {

// Readings of one channel around the stop.
struct RawSeries {
  Channel channel;
  std::vector<std::int64_t> time_ns;  // the same clock as the points of the run
  std::vector<double> value;          // unit of the channel; NaN: missing
  std::vector<Quality> quality;
};

// Draws one panel for each channel; there must be at least one. The time is in s and is 0 at the
// first averaged reading.
std::string raw_stop_svg(const StatedResults& results, std::size_t row,
                         const std::vector<RawSeries>& channels, Language language);

}  // namespace mdof::charts
