// The reference mark (index, Z) of an incremental encoder. When the axis passes the mark, the
// counter loads a preset number. From then on, the count has a fixed relation to the position of
// the axis.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// Detects from the counts alone whether the counter has loaded its preset at the mark. The preset
// differs from the present count by a quarter of the counter's range. No motion between two
// readings is so large. If the count jumps to a number that is not near the preset, the counter has
// not loaded the preset. Pure; thread-bound.
//
// If the polarity of the index is wrong, the counter loads the preset again and again at all
// positions except the mark. Therefore the state is `passed` only after the count has moved away
// from the preset. Until then the positions are unknown.
class IndexMark {
 public:
  enum class State {
    off,          // the mark is not awaited; call arm()
    awaited,      // arm() was called; the axis has not reached the mark
    at_mark,      // the counter has loaded the preset; the count has not moved away yet
    passed,       // counts are relative to the mark, until arm() is called again
    unexplained,  // neither a motion nor the mark explains the count; the object ignores this count
  };
  // `bits`: width of the counter (8 ... 62). take() and arm() expect unwrapped counts.
  explicit IndexMark(int bits) : bits_(bits), quarter_(std::int64_t{1} << (bits - 2)) {}

  // Starts to await the mark, at the present `count`. Returns the preset that the counter must load
  // at the mark; it has `bits` bits.
  std::uint64_t arm(std::int64_t count);
  // Evaluates the next reading of the counter.
  State take(std::int64_t count);

  State state() const { return state_; }
  bool armed() const { return state_ == State::awaited || state_ == State::at_mark; }
  std::uint64_t load() const;
  // Distance from the mark, in counts, of a count in State::passed.
  std::int64_t from_mark(std::int64_t count) const { return count - loaded_; }
  // Whether the axis has moved so far without passing the mark that the caller must call arm()
  // again. This is necessary only for counters with few bits.
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
