// Finds the side from which the axis moved to a stop.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>

namespace mdof::algo {

// A smaller motion back is not a reversal of the axis.
inline constexpr double kLeastTurn_m = 10e-6;

// Two measures of the motion. The path consists of positions that are far apart, so the noise of
// the encoder does not change it. The last motion is found from all positions. It also shows an
// overrun of an end target that is smaller than the distances of the path.
class MotionTrace {
 public:
  void clear() { *this = {}; }

  // Adds a position to the path if its distance from the last position is at least `least_m`.
  void remember(double position_m, double least_m) {
    if (!path_.empty() && std::abs(path_.back() - position_m) < least_m) return;
    path_.push_back(position_m);
    if (path_.size() > kPathLength) path_.pop_front();
  }

  // Takes the next position in time. The axis has reversed if it moved back by more than `turn_m`.
  void follow(double position_m, double turn_m) {
    if (!begun_) low_m_ = high_m_ = position_m;
    begun_ = true;
    if (heading_ <= 0) low_m_ = std::min(low_m_, position_m);
    if (heading_ >= 0) high_m_ = std::max(high_m_, position_m);
    if (heading_ <= 0 && position_m - low_m_ > turn_m) {
      heading_ = 1;
      high_m_ = position_m;
    } else if (heading_ >= 0 && high_m_ - position_m > turn_m) {
      heading_ = -1;
      low_m_ = position_m;
    }
  }

  // Direction of the last motion; 0: the axis has not yet moved.
  int heading() const { return heading_; }

  // Direction from the last position of the path that is farther than `least_m`; 0: unknown.
  int by_path(double position_m, double least_m) const {
    for (auto it = path_.rbegin(); it != path_.rend(); ++it)
      if (std::abs(*it - position_m) > least_m) return *it < position_m ? 1 : -1;
    return 0;
  }

  // Direction of the last motion; 0: unknown. If the axis moved past `position_m` by at most
  // `overshoot_m` and back, and came from more than twice as far from the other side, the last
  // motion was a correction, and the direction is that of the motion before. `min_m` and `max_m`:
  // range of the positions since the stop before.
  int by_last_motion(double position_m, double overshoot_m, double min_m, double max_m) const {
    const double above_m = max_m - position_m, below_m = position_m - min_m;
    const double past_m = heading_ > 0 ? position_m - low_m_ : high_m_ - position_m;
    const double before_m = heading_ > 0 ? above_m : below_m;
    const bool corrected = past_m <= overshoot_m && before_m > 2 * past_m;
    return corrected ? -heading_ : heading_;
  }

 private:
  static constexpr std::size_t kPathLength = 64;
  std::deque<double> path_;  // newest last
  bool begun_ = false;
  int heading_ = 0;
  // Lowest and highest position of the last motion: its start and its farthest position.
  double low_m_ = 0, high_m_ = 0;
};

}  // namespace mdof::algo
