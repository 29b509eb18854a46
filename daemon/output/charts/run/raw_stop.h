// The raw readings of one stop, as they were recorded, with the part that was averaged. Pure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "daemon/output/charts/run/run_charts.h"
#include "schema/sample.h"

namespace mdof::charts {

// Of one channel, around the stop.
struct RawSeries {
  Channel channel;
  std::vector<std::int64_t> time_ns;  // on the clock of the run's points
  std::vector<double> value;          // in the channel's unit; NaN: missing
  std::vector<Quality> quality;
};

// A panel a channel; time in s from the beginning of the averaged part. At least one channel.
std::string raw_stop_svg(const StatedResults& results, std::size_t row,
                         const std::vector<RawSeries>& channels, Language language);

}  // namespace mdof::charts
