// One quadrature counter of a LabJack, as its stream shows it: the count made whole, and whether it
// is still counted from the same place.
#pragma once

#include <cstdint>
#include <string>

#include "drivers/counter/unwrap.h"
#include "drivers/labjack/count_guard.h"

namespace mdof::drivers::labjack {

// For the life of a driver. Thread-bound.
class Counter {
 public:
  // 0: however fast it goes.
  explicit Counter(double most_counts_per_s = 0) : guard_(most_counts_per_s) {}

  // The device was opened; `went_on`: its count goes on from before.
  void take_up(bool went_on) {
    zero_lost_ = zero_lost_ || (used_ && !went_on);
    used_ = true;
    if (!went_on) count_.reset();
  }
  bool used() const { return used_; }
  void interrupt() { guard_.interrupt(); }  // it was closed
  // Of 32 bits as the device gives them; `time_s` is the device's own.
  std::int64_t take(std::uint32_t raw, double time_s) {
    const std::int64_t count = count_(raw);
    (void)guard_.take(count, time_s);
    return count;
  }
  bool sure() const { return guard_.sure() && !zero_lost_; }
  // "": its zero holds. `without_power`: what to say where it began from 0 again.
  std::string why_unsure(const char* without_power) const {
    return zero_lost_ ? without_power : guard_.sure() ? "" : kCountsLost;
  }
  void trust() {
    zero_lost_ = false;
    guard_.restart();
  }

 private:
  Unwrap count_{32, true};
  CountGuard guard_;
  bool used_ = false;  // since this object was made
  bool zero_lost_ = false;
};

}  // namespace mdof::drivers::labjack
