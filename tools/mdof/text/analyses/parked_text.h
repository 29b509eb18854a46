// The output of `mdof drift` for a log of a parked axis.
#pragma once

#include <cstddef>
#include <string>

#include "daemon/measure/replay/parked_log.h"

namespace mdof::tools {

// The drift rates in each time window, the correlation with the temperature, and the verdict.
std::string parked_text(const daemon::ParkedLog& log, const algo::WarmUp& found, std::size_t width);
std::string parked_json(const daemon::ParkedLog& log, const algo::WarmUp& found);
// States that the system is ready, or why it is not: a sentence without a full stop.
std::string parked_verdict(const daemon::ParkedLog& log, const algo::WarmUp& found);

}  // namespace mdof::tools
