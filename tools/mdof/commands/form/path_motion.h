// Stroke and acceleration of a tool path.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace mdof::tools {

// The extreme positions of a path, and its largest acceleration from second differences.
class Motion {
 public:
  void add(double z_m) {
    least_ = std::min(least_, z_m);
    most_ = std::max(most_, z_m);
    if (count_ >= 2) change_ = std::max(change_, std::abs(z_m - 2 * last_ + before_));
    before_ = last_;
    last_ = z_m;
    ++count_;
  }
  double stroke_m() const { return most_ - least_; }
  double acceleration_m_s2(double step_s) const { return change_ / (step_s * step_s); }

 private:
  double least_ = 1e300, most_ = -1e300, last_ = 0, before_ = 0, change_ = 0;
  std::size_t count_ = 0;
};

}  // namespace mdof::tools
