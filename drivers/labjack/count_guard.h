// LabJack's firmware counts the edges of an encoder one by one: faster than it can, it loses some
// without a word, and the position is wrong from then on.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers::labjack {

// Watches that a count stays below what can be counted. Over 10 ms, so that the few counts of one
// scan give a speed. Thread-bound.
class CountGuard {
 public:
  // 0: nothing is watched.
  explicit CountGuard(double most_counts_per_s = 0) : most_counts_per_s_(most_counts_per_s) {}

  // `time_s` is the device's own. From the first step that is too fast on, false: counts may be
  // lost.
  bool take(std::int64_t count, double time_s) {
    if (most_counts_per_s_ <= 0) return true;
    if (!begun_) mark(count, time_s);
    const double passed_s = time_s - mark_s_;
    const auto moved = static_cast<double>(std::abs(count - marked_));
    sure_ = sure_ && moved <= most_counts_per_s_ * std::max(passed_s, kWindow_s) + kSlack;
    if (passed_s >= kWindow_s) mark(count, time_s);
    return sure_;
  }
  bool sure() const { return sure_; }
  // Whatever was lost has been found again.
  void restart() {
    begun_ = false;
    sure_ = true;
  }
  // The next count is the first of another stream: what was between is not known.
  void interrupt() { begun_ = false; }

 private:
  static constexpr double kWindow_s = 0.01;
  static constexpr double kSlack = 2;  // counts

  void mark(std::int64_t count, double time_s) {
    begun_ = true;
    marked_ = count;
    mark_s_ = time_s;
  }

  double most_counts_per_s_;
  bool begun_ = false, sure_ = true;
  std::int64_t marked_ = 0;
  double mark_s_ = 0;
};

// `most_counts_per_s` of a channel; 0: not given. Rejects what is not above 0.
double read_most_counts_per_s(TomlTable& channel);
// For people: "counts up to 3.5 mm/s", the speed of the axis that a counter can follow; "" for 0.
std::string speed_text(double most_counts_per_s, double um_per_count);
inline constexpr const char* kCountsLost =
    "the encoder moved faster than most_counts_per_s, so counts may have been lost; move the axis "
    "more slowly";

}  // namespace mdof::drivers::labjack
