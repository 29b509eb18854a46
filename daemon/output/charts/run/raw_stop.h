// The recorded raw readings of one stop, with the averaged part. Pure.
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
  std::vector<std::int64_t> time_ns;  // clock of the run's points
  std::vector<double> value;          // unit of the channel; NaN: missing
  std::vector<Quality> quality;
};

// One panel for each channel (at least one); time in s from the beginning of the averaged part.
std::string raw_stop_svg(const StatedResults& results, std::size_t row,
                         const std::vector<RawSeries>& channels, Language language);

}  // namespace mdof::charts
