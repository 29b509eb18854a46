#include "drivers/simulator/motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "schema/base/random.h"
#include "schema/units.h"

namespace mdof::drivers {

Motion::Motion(const SimulatorOptions& options)
    : speed_m_s_(from_mm(options.speed_mm_s)),
      acceleration_m_s2_(from_mm(options.acceleration_mm_s2)),
      settle_m_(from_um(options.settle_um)),
      settle_hz_(options.settle_hz),
      settle_s_(options.settle_s) {
  std::vector<double> targets_mm = options.targets_mm;
  assert(!targets_mm.empty());
  const double low_m = from_mm(targets_mm.front() - options.overrun_mm);
  const double high_m = from_mm(targets_mm.back() + options.overrun_mm);
  position_m_ = low_m;
  for (int direction : {1, -1}) {
    for (double target_mm : targets_mm) {
      move_to(from_mm(target_mm), direction);
      append(position_m_, direction, true, options.dwell_s);
    }
    move_to(direction > 0 ? high_m : low_m, direction);
    std::reverse(targets_mm.begin(), targets_mm.end());
  }
  // With a single target, no rest and no overrun, the axis does not move. The axis then rests for 1
  // s, so that a cycle has a duration.
  if (cycle_ns() == 0) append(position_m_, 1, true, 1);
}

void Motion::append(double to_m, int direction, bool rest, double seconds) {
  const std::int64_t begin_ns = leg_.empty() ? 0 : cycle_ns();
  const auto length_ns = static_cast<std::int64_t>(std::llround(seconds * 1e9));
  leg_.push_back({begin_ns, length_ns, position_m_, to_m, direction, rest});
  position_m_ = to_m;
}

void Motion::move_to(double to_m, int direction) {
  const double distance_m = std::abs(to_m - position_m_);
  const double at_speed_s = 1.875 * distance_m / speed_m_s_;
  const double at_acceleration_s = std::sqrt(10 / std::sqrt(3.0) * distance_m / acceleration_m_s2_);
  append(to_m, direction, false, std::max(at_speed_s, at_acceleration_s));
}

double Motion::settling_m(const Leg& leg, double since_s) const {
  if (since_s >= settle_s_) return 0;
  const double left = 1 - since_s / settle_s_;
  return leg.direction * settle_m_ * left * left * left * sine_of_turns(settle_hz_ * since_s);
}

AxisState Motion::at(std::int64_t time_ns) const {
  const std::int64_t t = time_ns % cycle_ns();
  const auto next = std::upper_bound(leg_.begin(), leg_.end(), t,
                                     [](std::int64_t x, const Leg& l) { return x < l.begin_ns; });
  const Leg& leg = *(next - 1);
  if (leg.rest) {
    const double since_s = ns_to_s(t - leg.begin_ns);
    return {leg.to_m + settling_m(leg, since_s), leg.direction, true};
  }
  const double tau = static_cast<double>(t - leg.begin_ns) / static_cast<double>(leg.length_ns);
  const double s = tau * tau * tau * (10 + tau * (6 * tau - 15));
  return {leg.from_m + (leg.to_m - leg.from_m) * s, leg.direction, false};
}

}  // namespace mdof::drivers
