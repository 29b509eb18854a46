// The reference mark (index, Z) of an encoder that counts: when the axis goes over it, the counter
// loads the value it was given, and from there the same count is the same place each time.
#pragma once

#include <cstdint>

namespace mdof::drivers {

// Finds from the counts alone whether the counter has loaded at the mark. It has to load a
// number a quarter of its range away from where it stands: no motion between two readings leads
// there, and a count that jumps to elsewhere was not at the mark. Pure; thread-bound.
//
// With the polarity of the index the wrong way round the counter loads at every place but the mark,
// again and again. So the mark counts as passed only once the count has gone on from it, and until
// then no place is known.
class IndexMark {
 public:
  enum class State {
    off,      // not armed
    awaited,  // the axis has not been there
    at_mark,  // the counter has loaded, and has not gone on since
    passed,   // counts are from the mark, until armed anew
    astray,   // the count is where neither motion nor the mark brings it; as before with the next
  };
  // Of a counter of `bits` bits (8 ... 62) whose counts are handed in unwrapped.
  explicit IndexMark(int bits) : bits_(bits), quarter_(std::int64_t{1} << (bits - 2)) {}

  // The counter stands at `count`. What it is to load at the mark: `bits` bits.
  std::uint64_t arm(std::int64_t count);
  // The next reading.
  State take(std::int64_t count);

  State state() const { return state_; }
  bool armed() const { return state_ == State::awaited || state_ == State::at_mark; }
  std::uint64_t load() const;
  // How far a count of State::passed is from the mark.
  std::int64_t from_mark(std::int64_t count) const { return count - loaded_; }
  // The axis went so far without the mark that it is to be armed anew; only where bits are few.
  bool far_from_armed(std::int64_t count) const;

 private:
  State gone_on(std::int64_t from_mark);

  int bits_;
  std::int64_t quarter_;
  State state_ = State::off;
  std::int64_t armed_ = 0, loaded_ = 0;
  int readings_at_mark_ = 0;
};

}  // namespace mdof::drivers
