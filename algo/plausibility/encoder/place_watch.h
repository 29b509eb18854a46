// Which frames have a place: the encoder gave a position that the axis can have reached.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/sample.h"

namespace mdof::algo {

// A frame without a position (NaN) has no place. Nor has a frame whose position the axis cannot
// have reached from the last place at its maximum speed, as after an overflow of the count (2^32
// counts). The frames after a stray position have no place either, until the position jumps back to
// where the axis can be, or is ten times nearer to the last place than to the stray position, as
// after a disturbance.
// A stream: the result does not depend on how the frames are divided.
class PlaceWatch {
 public:
  explicit PlaceWatch(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  // Position of the axis when the frames begin. Before this call only NaN is left out.
  void begin_at(std::int64_t time_ns, double position_m);
  // End of the consecutive frames from `from` on that have a place, or that have no place.
  std::size_t find_placed_end(const FrameBlock& frames, std::size_t from);
  std::size_t find_unplaced_end(const FrameBlock& frames, std::size_t from);

  bool is_placed(std::int64_t time_ns, double position_m) const;
  std::uint64_t left_out() const { return missing_ + too_fast_; }
  // One notice for each kind: how many, and since when.
  Notices notices(std::int64_t start_ns) const;

 private:
  struct Place {
    std::int64_t time_ns = 0;
    double position_m = 0;
  };
  double out_of_reach_m(const Place& from, std::int64_t time_ns, double position_m) const;
  void leave_out(std::int64_t time_ns, double position_m);

  double max_speed_m_s_;
  bool begun_ = false, is_stray_ = false;
  Place last_, stray_;  // last place; last position without place, while is_stray_
  std::uint64_t missing_ = 0, too_fast_ = 0;
  std::int64_t first_missing_ns_ = 0, first_too_fast_ns_ = 0, astray_since_ns_ = 0;
  double first_jump_m_ = 0, jumped_from_m_ = 0;
};

}  // namespace mdof::algo
