#include "algo/on_the_fly/passes.h"

#include <algorithm>
#include <string>

#include "algo/points/frame_rows.h"

namespace mdof::algo {
namespace {

constexpr double kTurn_m = 50e-6;
constexpr std::size_t kDropRows = 4096;

}  // namespace

double median_position(const FrameBlock& frames, std::size_t row) {
  const double here = frames.encoder_m[row];
  if (row == 0 || row + 1 >= frames.size()) return here;
  const double before = frames.encoder_m[row - 1], after = frames.encoder_m[row + 1];
  return std::max(std::min(before, here), std::min(std::max(before, here), after));
}

Status PassFinder::push(const FrameBlock& frames, std::size_t first, std::size_t last,
                        const Take& take) {
  if (rows_.probe_m.empty()) rows_ = empty_frames(frames.probe_m.size());
  append_rows(rows_, frames, first, last);
  for (; next_ + 1 < rows_.size(); ++next_) follow(next_, median_position(rows_, next_), take);
  if (begin_ > kDropRows) {
    erase_rows(rows_, 0, begin_);
    low_.row -= std::min(low_.row, begin_);
    high_.row -= std::min(high_.row, begin_);
    next_ -= begin_;
    begin_ = 0;
  }
  if (rows_.size() - begin_ <= kMostScans) return {};
  return bad_input(
      "one pass (motion in one direction, or standstill) has more scans than the limit of " +
      std::to_string(kMostScans) + "; divide the log, or record at a lower rate");
}

void PassFinder::follow(std::size_t row, double at_m, const Take& take) {
  if (!begun_) low_ = high_ = {row, at_m};
  begun_ = true;
  if (at_m < low_.at_m) low_ = {row, at_m};
  if (at_m > high_.at_m) high_ = {row, at_m};
  if (heading_ <= 0 && at_m - low_.at_m > kTurn_m) turn(1, low_, take);
  if (heading_ >= 0 && high_.at_m - at_m > kTurn_m) turn(-1, high_, take);
}

// `at`: the last position before the axis reversed.
void PassFinder::turn(int heading, Extreme at, const Take& take) {
  if (heading_ != 0) take({rows_, begin_, at.row + 1, heading_});
  heading_ = heading;
  begin_ = at.row;
  low_ = high_ = at;
}

void PassFinder::flush(const Take& take) {
  if (heading_ != 0 && rows_.size() > begin_ + 1) take({rows_, begin_, rows_.size(), heading_});
  heading_ = 0;
  rows_ = empty_frames(rows_.probe_m.size());
  next_ = begin_ = 0;
  begun_ = false;
}

}  // namespace mdof::algo
