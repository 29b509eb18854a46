// Channels whose sampling interval is longer than the gap of the aligner.
#pragma once

#include <string>
#include <vector>

#include "algo/points/align.h"
#include "drivers/driver.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// `align` with the sampling intervals of those channels whose gap they make longer.
algo::AlignOptions with_intervals(algo::AlignOptions align,
                                  const std::vector<drivers::DeviceInfo>& devices);

// Error: all values of the device would be missing, because its sampling interval exceeds the
// requested gap (`gap_given`) or half of the lag bound. The message states which key to set. Call
// it if readings are interpolated.
Status check_rate(const drivers::DeviceInfo& device, const algo::AlignOptions& align,
                  bool gap_given);

}  // namespace mdof::daemon
