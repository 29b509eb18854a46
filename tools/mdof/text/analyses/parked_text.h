// What `mdof drift` says of a log of a parked axis.
#pragma once

#include <cstddef>
#include <string>

#include "daemon/measure/replay/parked_log.h"

namespace mdof::tools {

// Rates of each window, what goes with the temperature, and the verdict.
std::string parked_text(const daemon::ParkedLog& log, const algo::WarmUp& found, std::size_t width);
std::string parked_json(const daemon::ParkedLog& log, const algo::WarmUp& found);
// Whether it is ready, or what keeps it: a sentence without a full stop.
std::string parked_verdict(const daemon::ParkedLog& log, const algo::WarmUp& found);

}  // namespace mdof::tools
