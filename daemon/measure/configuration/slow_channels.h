// Options for channels whose sampling interval is longer than the longest gap that the aligner
// permits.
#pragma once

#include <string>
#include <vector>

#include "algo/points/align.h"
#include "drivers/driver.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// Adds sampling intervals of channels to `align`. An interval is added only if it makes the
// permitted gap of its channel longer.
algo::AlignOptions with_intervals(algo::AlignOptions align,
                                  const std::vector<drivers::DeviceInfo>& devices);

// Error: all values of the device would be missing, because the sampling interval is longer than
// align.max_gap_s (tested only if `gap_given`) or longer than half of align.lag_bound_s. The
// message states which key to set. This check is for interpolated readings only.
Status check_rate(const drivers::DeviceInfo& device, const algo::AlignOptions& align,
                  bool gap_given);

}  // namespace mdof::daemon
