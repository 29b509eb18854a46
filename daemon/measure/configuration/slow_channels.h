// Channels of devices that sample more slowly than a gap is long: which, and what cannot work.
#pragma once

#include <string>
#include <vector>

#include "algo/points/align.h"
#include "drivers/driver.h"
#include "schema/base/result.h"

namespace mdof::daemon {

// With the intervals of those channels whose devices state a rate so low that `align` needs them.
algo::AlignOptions with_intervals(algo::AlignOptions align,
                                  const std::vector<drivers::DeviceInfo>& devices);

// Error: a device of an axis with several can give nothing but missing values, since it samples
// less often than a gap that was asked for (`gap_given`) or than the lag bound. Says what to set.
Status check_rate(const drivers::DeviceInfo& device, const algo::AlignOptions& align,
                  bool gap_given);

}  // namespace mdof::daemon
