#include "drivers/clock/device_clock.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>
#include <vector>

namespace mdof::drivers {
namespace {

constexpr double kStretch_ns = 0.25e9;
constexpr std::size_t kStretches = 256;      // together 64 s
constexpr std::size_t kStretchesToFit = 16;  // 4 s; before the first fit, the nominal rate is used
// 1 s; after this time, opening the device no longer delays packets.
constexpr std::size_t kStretchesToBegin = 4;
// The line is fitted again when 1/32 of the stretches are new.
constexpr std::size_t kRefitDivisor = 32;
constexpr double kMostDrift = 1e-3;  // 1000 ppm; no clock has a larger drift
constexpr double kSlew = 2e-3;       // largest correction of the returned time / elapsed time
// The same before the first fit; the value is large, so that the offset is corrected quickly.
constexpr double kFirstSlew = 0.2;
// Larger than any jitter: the limit before the first fit, and the largest limit after it.
constexpr double kStep_ns = 0.1e9;
// Smallest limit after the first fit. Many adapters of a serial line send only every 16 ms, so that
// the delay may change by 16 ms.
constexpr double kLeastStep_ns = 20e6;
constexpr double kStepScatters = 10;
constexpr std::size_t kLatePackets = 8;  // single packets may be late
// If packets are late for a longer time, the clock has stepped.
constexpr std::int64_t kLongestLateness_ns = 60'000'000'000;

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

DeviceClock::DeviceClock(double nominal_tick_ns) : tick_ns_(nominal_tick_ns), limit_ns_(kStep_ns) {
  assert(nominal_tick_ns > 0);
}

void DeviceClock::reset() {
  const std::int64_t given_ns = returned_ns_;
  const std::uint64_t steps = steps_;
  *this = DeviceClock(tick_ns_);
  returned_ns_ = given_ns;  // the returned times still do not decrease
  steps_ = steps;
}

double DeviceClock::nominal_ns(std::int64_t ticks) const {
  return static_cast<double>(ticks - *first_ticks_) * tick_ns_;
}

void DeviceClock::add(std::int64_t ticks, std::int64_t received_ns) {
  if (!first_ticks_) {
    first_ticks_ = ticks;
    first_ns_ = received_ns;
  }
  // A count that decreases shows that the device has restarted its count.
  if (std::exchange(last_ticks_, ticks).value_or(ticks) > ticks) return step(ticks, received_ns);
  const double nominal = nominal_ns(ticks);
  const double offset = static_cast<double>(received_ns - *first_ns_) - nominal;
  // The packet arrived earlier than it can have been sent. This shows that the device's time has
  // jumped forward.
  if (offset < intercept_ns_ + slope_ * nominal - limit_ns_) return step(ticks, received_ns);
  if (!best_.empty() && is_late(offset, nominal, received_ns)) {
    if (received_ns - *late_since_ns_ > kLongestLateness_ns) step(ticks, received_ns);
    return;
  }
  take(ticks, received_ns, offset, nominal);
}

// Late packets are not used for the line. Packets that are less late than kStep_ns must persist.
bool DeviceClock::is_late(double offset_ns, double nominal_ns, std::int64_t received_ns) {
  late_ns_ = offset_ns - (intercept_ns_ + slope_ * nominal_ns);
  if (late_ns_ <= limit_ns_) {
    behind_ = 0;
    late_since_ns_.reset();
    return false;
  }
  if (++behind_ == 1) behind_since_ns_ = received_ns;
  const bool persists =
      behind_ >= kLatePackets && static_cast<double>(received_ns - behind_since_ns_) >= kStretch_ns;
  if (!late_since_ns_ && (persists || late_ns_ > kStep_ns)) late_since_ns_ = received_ns;
  return late_since_ns_.has_value();
}

void DeviceClock::take(std::int64_t ticks, std::int64_t received_ns, double offset,
                       double nominal) {
  const auto stretch = static_cast<std::int64_t>(std::floor(nominal / kStretch_ns));
  if (best_.empty() || best_.back().stretch != stretch) {
    if (++unfitted_ * kRefitDivisor > best_.size()) fit();
    best_.push_back({stretch, ticks, received_ns, offset, offset});
    if (best_.size() > kStretches) best_.pop_front();
  } else {
    Best& b = best_.back();
    b.latest_ns = std::max(b.latest_ns, offset);
    if (offset < b.offset_ns) b = {stretch, ticks, received_ns, offset, b.latest_ns};
  }
  if (!fitted_) intercept_ns_ = std::min(intercept_ns_, offset);  // the first packet has offset 0
}

void DeviceClock::step(std::int64_t ticks, std::int64_t received_ns) {
  const std::size_t uncertain =
      std::max(uncertain_stretches_, fitted_ ? kStretchesToFit : kStretchesToBegin);
  reset();
  ++steps_;
  uncertain_stretches_ = uncertain;
  add(ticks, received_ns);
}

// Fits the line to the quickest packet of each complete stretch.
void DeviceClock::fit() {
  if (best_.size() < kStretchesToFit) return;
  unfitted_ = 0;
  std::vector<double> slopes, rest;
  slopes.reserve(best_.size() * (best_.size() - 1) / 2);
  for (std::size_t i = 0; i < best_.size(); ++i)
    for (std::size_t j = i + 1; j < best_.size(); ++j)
      slopes.push_back((best_[j].offset_ns - best_[i].offset_ns) /
                       (nominal_ns(best_[j].ticks) - nominal_ns(best_[i].ticks)));
  slope_ = std::clamp(median(slopes), -kMostDrift, kMostDrift);
  for (const Best& b : best_) rest.push_back(b.offset_ns - slope_ * nominal_ns(b.ticks));
  intercept_ns_ = median(rest);
  for (double& r : rest) r = std::abs(r - intercept_ns_);
  limit_ns_ = std::min(kStep_ns, kLeastStep_ns + kStepScatters * median(rest));
  fitted_ = true;
}

bool DeviceClock::doubtful() const {
  return late_since_ns_ || best_.size() <= uncertain_stretches_;
}

std::int64_t DeviceClock::host_ns(std::int64_t ticks) {
  assert(first_ticks_);
  const double nominal = nominal_ns(ticks);
  const double wanted = intercept_ns_ + slope_ * nominal;
  if (!has_returned_time_) {
    returned_offset_ns_ = wanted;
    has_returned_time_ = true;
  } else {
    const double passed = std::max(0.0, nominal - nominal_ns(returned_ticks_));
    const double on_line = returned_offset_ns_ + slope_ * passed;
    const double most = (fitted_ ? kSlew : kFirstSlew) * passed;
    returned_offset_ns_ = std::clamp(wanted, on_line - most, on_line + most);
  }
  returned_ticks_ = ticks;
  const std::int64_t ns = *first_ns_ + std::llround(nominal + returned_offset_ns_);
  returned_ns_ = std::max(ns, returned_ns_ + 1);
  return returned_ns_;
}

ClockState DeviceClock::state() const {
  ClockState state;
  // If the device's clock is fast, more nominal time passes than real time, so the offset
  // decreases.
  state.drift_ppm = -slope_ * 1e6;
  state.settled = fitted_;
  state.steps = steps_;
  state.doubtful = doubtful();
  state.late_ns = late_since_ns_ ? std::llround(late_ns_) : 0;
  if (best_.empty()) return state;
  std::vector<double> spreads;
  for (const Best& b : best_) spreads.push_back(b.latest_ns - b.offset_ns);
  state.jitter_ns = std::llround(median(spreads));
  return state;
}

}  // namespace mdof::drivers
