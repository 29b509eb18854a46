#include "drivers/counter/index_mark.h"

#include <cstdlib>

namespace mdof::drivers {
namespace {

// With a wrong polarity of the index, the counter loads the preset once in each signal period,
// which has at most four counts. A single reading may be wrong, so several readings are needed.
constexpr std::int64_t kLeastMove_counts = 16;
constexpr int kReadings = 3;
// A quarter of the counter's range, divided by these numbers, is
// - kMotion: the largest plausible motion without the mark;
// - kBeyondMark: the largest plausible motion between the mark and the next reading;
// - kFar: the distance at which arm() is needed again.
constexpr std::int64_t kMotion = 2, kBeyondMark = 64, kFar = 4;

}  // namespace

std::uint64_t IndexMark::arm(std::int64_t count) {
  state_ = State::awaited;
  armed_ = count;
  loaded_ = count + quarter_;
  return load();
}

std::uint64_t IndexMark::load() const {
  return static_cast<std::uint64_t>(loaded_) & ((std::uint64_t{1} << bits_) - 1);
}

bool IndexMark::far_from_armed(std::int64_t count) const {
  return std::abs(count - armed_) > quarter_ / kFar;
}

IndexMark::State IndexMark::take(std::int64_t count) {
  if (!armed()) return state_;
  if (std::abs(count - armed_) <= quarter_ / kMotion) return state_ = State::awaited;
  if (std::abs(from_mark(count)) > quarter_ / kBeyondMark) return State::unexplained;
  return state_beyond_mark(from_mark(count));
}

IndexMark::State IndexMark::state_beyond_mark(std::int64_t from_mark) {
  if (state_ == State::awaited) readings_at_mark_ = 0;
  const bool gone = std::abs(from_mark) > kLeastMove_counts;
  return state_ = gone && ++readings_at_mark_ >= kReadings ? State::passed : State::at_mark;
}

}  // namespace mdof::drivers
