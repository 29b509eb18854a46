// A quadrature counter in a LabJack stream. The class extends the 32-bit count over its overflows
// and detects whether the zero of the count was lost.
#pragma once

#include <cstdint>
#include <string>

#include "drivers/counter/unwrap.h"
#include "drivers/labjack/count_guard.h"

namespace mdof::drivers::labjack {

// The object exists as long as its driver. Thread-bound.
class Counter {
 public:
  // `most_counts_per_s` 0: the counting rate has no limit.
  explicit Counter(double most_counts_per_s = 0) : guard_(most_counts_per_s) {}

  // The driver has opened the device. `kept_count`: whether the counter has kept its count since
  // the device was last open.
  void resume_count(bool kept_count) {
    zero_lost_ = zero_lost_ || (used_ && !kept_count);
    used_ = true;
    if (!kept_count) count_.reset();
  }
  bool used() const { return used_; }
  void interrupt() { guard_.interrupt(); }  // the driver has closed the device
  // `raw`: 32-bit count of the device; `time_s`: time of the device's clock.
  std::int64_t take(std::uint32_t raw, double time_s) {
    const std::int64_t count = count_(raw);
    (void)guard_.take(count, time_s);
    return count;
  }
  bool sure() const { return guard_.sure() && !zero_lost_; }
  // The reason why the zero of the count is not valid; "": it is valid. `without_power`: the reason
  // to return if the count has started again from 0.
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
  bool used_ = false;  // whether resume_count() was called
  bool zero_lost_ = false;
};

}  // namespace mdof::drivers::labjack
