// Decides which frames have a valid position, here called a place. The position of a frame is valid
// if the axis can have reached it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "schema/notice/notice.h"
#include "schema/sample.h"

namespace mdof::algo {

// Three kinds of frames have no place:
// - a frame without a position (NaN)
// - a frame with a stray position: the axis cannot have reached it from the last place at its
//   maximum speed, for example after an overflow of the count (2^32 counts)
// - the frames after a stray position, until the position jumps back to a position that the axis
//   can have reached, or until it is ten times nearer to the last place than to the stray position,
//   as after a disturbance
//
// The result does not depend on how the frames are divided into blocks.
class PlaceWatch {
 public:
  explicit PlaceWatch(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  // Sets the position of the axis before the first frame. Before this call only frames with NaN are
  // left out.
  void begin_at(std::int64_t time_ns, double position_m);
  // Returns the end of the consecutive frames from `from` on that have a place (or, for
  // find_unplaced_end(), no place).
  std::size_t find_placed_end(const FrameBlock& frames, std::size_t from);
  std::size_t find_unplaced_end(const FrameBlock& frames, std::size_t from);

  bool is_placed(std::int64_t time_ns, double position_m) const;
  std::uint64_t left_out() const { return missing_ + too_fast_; }
  // Returns one notice for missing positions and one for stray positions, with their number and the
  // first time.
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
  Place last_, stray_;  // last_: last place; stray_: last position without place, while is_stray_
  std::uint64_t missing_ = 0, too_fast_ = 0;
  std::int64_t first_missing_ns_ = 0, first_too_fast_ns_ = 0, astray_since_ns_ = 0;
  double first_jump_m_ = 0, jumped_from_m_ = 0;
};

}  // namespace mdof::algo
