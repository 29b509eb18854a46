// Which frames have a place: the encoder gave one, and the axis can have got there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/sample.h"

namespace mdof::algo {

// A frame without a position (NaN) has no place. Neither has one whose position the axis cannot
// have reached from the last place at its greatest speed, as after a count that overflowed (2^32
// counts); those that go on from there have none either, until the position jumps back to where the
// axis can be, or is ten times nearer to the last place than to the stray one, as after a
// disturbance.
// Streaming; the same however the frames are cut.
class PlaceWatch {
 public:
  explicit PlaceWatch(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  // Where the axis is when the frames begin; before, only NaN is left out.
  void begin_at(std::int64_t time_ns, double position_m);
  // The end of the frames from `from` on that have a place, or have none.
  std::size_t end_of_placed(const FrameBlock& frames, std::size_t from);
  std::size_t end_of_unplaced(const FrameBlock& frames, std::size_t from);

  bool is_placed(std::int64_t time_ns, double position_m) const;
  std::uint64_t left_out() const { return missing_ + too_fast_; }
  // One for either kind: how many, since when.
  Notices notices(std::int64_t start_ns) const;

 private:
  struct Place {
    std::int64_t time_ns = 0;
    double position_m = 0;
  };
  double out_of_reach_m(const Place& from, std::int64_t time_ns, double position_m) const;
  void leave_out(std::int64_t time_ns, double position_m);

  double max_speed_m_s_;
  bool begun_ = false, astray_ = false;
  Place last_, stray_;  // the last that was placed; the last that was not, while astray_
  std::uint64_t missing_ = 0, too_fast_ = 0;
  std::int64_t first_missing_ns_ = 0, first_too_fast_ns_ = 0, astray_since_ns_ = 0;
  double first_jump_m_ = 0, jumped_from_m_ = 0;
};

}  // namespace mdof::algo
