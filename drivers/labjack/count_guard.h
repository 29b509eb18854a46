// The firmware of a LabJack counts each edge of an encoder signal. If the edges follow each other
// too fast, the firmware loses edges without a report, and all later positions are wrong.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

#include "schema/base/toml/toml_reader.h"

namespace mdof::drivers::labjack {

// Checks that the counting rate stays below its limit. The rate is measured over at least 10 ms,
// because the counts of one scan are too few. Thread-bound.
class CountGuard {
 public:
  // `most_counts_per_s` 0: the rate is not checked.
  explicit CountGuard(double most_counts_per_s = 0) : most_counts_per_s_(most_counts_per_s) {}

  // `time_s`: time of the device's clock. Returns false from the first interval on in which the
  // rate was too high, because counts may be lost.
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
  // Call this after the user has set the position of the axis: the count is then valid again.
  void restart() {
    begun_ = false;
    sure_ = true;
  }
  // The next count belongs to another stream. The motion between the two streams is unknown.
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

// Reads the key `most_counts_per_s` of a channel; returns 0 if it is not given. Rejects values that
// are not above 0.
double read_most_counts_per_s(TomlTable& channel);
// Text for users: "counts up to 3.5 mm/s". It states the highest speed of the axis that the counter
// can follow. Returns "" for a limit of 0.
std::string speed_text(double most_counts_per_s, double um_per_count);
inline constexpr const char* kCountsLost =
    "the encoder moved faster than most_counts_per_s, so counts may have been lost; move the axis "
    "more slowly";

}  // namespace mdof::drivers::labjack
