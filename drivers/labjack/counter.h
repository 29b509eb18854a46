// One quadrature counter of a LabJack stream: unwraps the count and checks that its zero is
// unchanged.
#pragma once

#include <cstdint>
#include <string>

#include "drivers/counter/unwrap.h"
#include "drivers/labjack/count_guard.h"

namespace mdof::drivers::labjack {

// Exists as long as the driver. Thread-bound.
class Counter {
 public:
  // 0: no limit of the counting rate.
  explicit Counter(double most_counts_per_s = 0) : guard_(most_counts_per_s) {}

  // The device was opened. `kept_count`: the counter kept its count since the device was last open.
  void resume_count(bool kept_count) {
    zero_lost_ = zero_lost_ || (used_ && !kept_count);
    used_ = true;
    if (!kept_count) count_.reset();
  }
  bool used() const { return used_; }
  void interrupt() { guard_.interrupt(); }  // the device was closed
  // `raw`: the 32-bit count of the device; `time_s`: time of the device.
  std::int64_t take(std::uint32_t raw, double time_s) {
    const std::int64_t count = count_(raw);
    (void)guard_.take(count, time_s);
    return count;
  }
  bool sure() const { return guard_.sure() && !zero_lost_; }
  // "": the zero is valid. `without_power`: text for a count that has started again from 0.
  std::string invalid_reason(const char* without_power) const {
    return zero_lost_ ? without_power : guard_.sure() ? "" : kCountsLost;
  }
  void trust() {
    zero_lost_ = false;
    guard_.restart();
  }

 private:
  Unwrap count_{32, true};
  CountGuard guard_;
  bool used_ = false;  // since this object was created
  bool zero_lost_ = false;
};

}  // namespace mdof::drivers::labjack
