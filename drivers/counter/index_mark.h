// The reference mark (index, Z) of an incremental encoder. When the axis passes the mark, the
// counter loads a preset number; from then on equal counts mean equal positions.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// Detects from the counts alone whether the counter has loaded its preset at the mark. The preset
// is a quarter of the counter's range away from the present count, so no motion between two
// readings can reach it. A count that jumps elsewhere was not loaded at the mark. Pure;
// thread-bound.
//
// If the polarity of the index is wrong, the counter loads the preset again and again at all
// positions except the mark. Therefore the mark counts as passed only after the count has moved on
// from the preset. Until then positions are unknown.
class IndexMark {
 public:
  enum class State {
    off,      // not armed
    awaited,  // the axis has not reached the mark
    at_mark,  // the counter has loaded the preset and has not moved on
    passed,   // counts are relative to the mark, until armed again
    astray,   // neither motion nor the mark explains this count; the next is judged afresh
  };
  // `bits`: width of the counter (8 ... 62). take() and arm() expect unwrapped counts.
  explicit IndexMark(int bits) : bits_(bits), quarter_(std::int64_t{1} << (bits - 2)) {}

  // Arms the detection at the present `count`. Returns the preset to load at the mark, `bits` wide.
  std::uint64_t arm(std::int64_t count);
  // The next reading.
  State take(std::int64_t count);

  State state() const { return state_; }
  bool armed() const { return state_ == State::awaited || state_ == State::at_mark; }
  std::uint64_t load() const;
  // Distance of a count in State::passed from the mark, counts.
  std::int64_t from_mark(std::int64_t count) const { return count - loaded_; }
  // Whether the axis has moved so far without the mark that arm() is needed again. Only counters
  // with few bits need this.
  bool far_from_armed(std::int64_t count) const;

 private:
  State state_beyond_mark(std::int64_t from_mark);

  int bits_;
  std::int64_t quarter_;
  State state_ = State::off;
  std::int64_t armed_ = 0, loaded_ = 0;
  int readings_at_mark_ = 0;
};

}  // namespace mdof::drivers
