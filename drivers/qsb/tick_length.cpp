#include "drivers/qsb/tick_length.h"

#include <cmath>

namespace mdof::drivers {
namespace {

constexpr std::int64_t kFirstSpan_ns = 500'000'000, kLastSpan_ns = 64'000'000'000;
constexpr double kDelay_ns = 10e6;

}  // namespace

void TickLength::restart() {
  *this = TickLength(ns_);
}

void TickLength::keep_quickest(Packet& best, std::int64_t ticks, std::int64_t received_ns) const {
  const double later_ns = static_cast<double>(received_ns - best.received_ns) -
                          static_cast<double>(ticks - best.ticks) * ns_;
  if (!best.any || later_ns < 0) best = {ticks, received_ns, true};
}

void TickLength::add(std::int64_t ticks, std::int64_t received_ns) {
  if (!first_.any) first_ = {ticks, received_ns, true};
  const std::int64_t age_ns = received_ns - first_.received_ns;
  if (age_ns <= kFirstSpan_ns / 4) return keep_quickest(early_, ticks, received_ns);
  if (span_ns_ > kLastSpan_ns || age_ns < span_ns_ - span_ns_ / 4) return;
  keep_quickest(late_, ticks, received_ns);
  if (age_ns < span_ns_) return;
  const auto passed_ns = static_cast<double>(late_.received_ns - early_.received_ns);
  const double measured_ns = passed_ns / static_cast<double>(late_.ticks - early_.ticks);
  if (std::abs(measured_ns / ns_ - 1) > kDelay_ns / passed_ns) ns_ = measured_ns;
  late_ = {};
  while (span_ns_ <= age_ns) span_ns_ *= 2;
}

}  // namespace mdof::drivers
