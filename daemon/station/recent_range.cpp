#include "daemon/station/recent_range.h"

#include <algorithm>
#include <cmath>

namespace mdof::daemon {
namespace {

void widen(RecentRange::Range& range, const double* begin, const double* end) {
  for (const double* reading = begin; reading != end; ++reading) {
    // If one value is NaN, fmin returns the other value.
    range.low_m = std::fmin(range.low_m, *reading);
    range.high_m = std::fmax(range.high_m, *reading);
  }
}

// Division that rounds down, also for the negative times of some logs.
std::int64_t quotient(std::int64_t x, std::int64_t by) {
  return x / by - (x % by < 0 ? 1 : 0);
}

}  // namespace

void RecentRange::add(const FrameBlock& frames) {
  for (std::size_t begin = 0; begin < frames.size();) {
    const std::int64_t number = quotient(frames.time_ns[begin], kPart_ns);
    const auto after = std::lower_bound(frames.time_ns.begin() + static_cast<std::ptrdiff_t>(begin),
                                        frames.time_ns.end(), (number + 1) * kPart_ns);
    const auto end = static_cast<std::size_t>(after - frames.time_ns.begin());
    if (number < newest_) *this = {};
    const auto n = static_cast<std::int64_t>(kParts);
    Part& part = parts_[static_cast<std::size_t>(number - n * quotient(number, n))];
    if (part.probes.empty() || part.number != number)
      part = {number, std::vector<Range>(frames.probe_m.size())};
    for (std::size_t k = 0; k < frames.probe_m.size(); ++k)
      widen(part.probes[k], frames.probe_m[k].data() + begin, frames.probe_m[k].data() + end);
    newest_ = number;
    begin = end;
  }
}

RecentRange::Range RecentRange::of(std::size_t probe) const {
  Range all;
  for (const Part& part : parts_) {
    if (part.probes.empty() || part.number <= newest_ - static_cast<std::int64_t>(kParts)) continue;
    const Range& range = part.probes[probe];
    all.low_m = std::fmin(all.low_m, range.low_m);
    all.high_m = std::fmax(all.high_m, range.high_m);
  }
  return all;
}

}  // namespace mdof::daemon
