#include "drivers/capancdt/frame_counter.h"

#include <algorithm>
#include <string>
#include <utility>

namespace mdof::drivers::capancdt {
namespace {

constexpr int kVotes = 3;              // number of steps that must agree with the unit
constexpr std::size_t kMostHeld = 32;  // largest number of packets that are kept back
// A packet is a duplicate if its counter is at most this number of packets before the last packet.
// If more duplicates than this follow each other, the counter was reset.
constexpr int kMostDuplicates = 64;

// Signed difference of the counters, b - a. The counter overflows at 2^32.
std::int32_t moved(const Packet& a, const Packet& b) {
  return static_cast<std::int32_t>(b.counter - a.counter);
}

tl::unexpected<Error> jumped(const Packet& last, const Packet& packet) {
  return io_error("the counter in the data jumped from " + std::to_string(last.counter) + " to " +
                  std::to_string(packet.counter) +
                  "; the controller was restarted or its settings were changed");
}

}  // namespace

FrameCounter::FrameCounter(int averaged, std::uint64_t most_lost)
    : averaged_(averaged), most_lost_(most_lost) {}

Status FrameCounter::add(Packet packet, std::deque<PlacedPacket>& placed) {
  if (!held_.empty()) {
    if (is_duplicate(held_.back(), packet)) return drop_duplicate(held_.back(), packet);
  } else if (last_) {
    const Packet& last = last_->packet;
    if (is_duplicate(last, packet)) return drop_duplicate(last, packet);
    const auto counted = static_cast<std::uint32_t>(moved(last, packet));
    if (last.channel_bits != packet.channel_bits || (unit_ && counted < step(last, *unit_)))
      unit_.reset();
  }
  duplicates_in_a_row_ = 0;
  return unit_ ? place(std::move(packet), placed) : hold(std::move(packet), placed);
}

std::uint64_t FrameCounter::step(const Packet& packet, CounterUnit unit) const {
  const auto frames = static_cast<std::uint64_t>(packet.frames());
  switch (unit) {
    case CounterUnit::frame:
      return frames;
    case CounterUnit::value:
      return frames * static_cast<std::uint64_t>(packet.channels());
    case CounterUnit::sample:
      return frames * static_cast<std::uint64_t>(averaged_);
    case CounterUnit::packet:
      return 1;
  }
  return frames;
}

// Number of frames for `counted` counts. A lost packet is assumed to have as many frames as the
// packet before it.
double FrameCounter::frames(std::uint64_t counted, const Packet& before) const {
  return static_cast<double>(counted) * before.frames() / static_cast<double>(step(before, *unit_));
}

Status FrameCounter::hold(Packet packet, std::deque<PlacedPacket>& placed) {
  if (!held_.empty()) vote(held_.back(), packet);
  held_.push_back(std::move(packet));
  // If several units have the most votes, the first of these units is used.
  const auto best = std::max_element(votes_.begin(), votes_.end());
  if (*best < kVotes) {
    if (held_.size() < kMostHeld) return {};
    return io_error(
        "the counter in the data does not count frames, values or packets; check the averaging of "
        "the controller");
  }
  unit_ = static_cast<CounterUnit>(best - votes_.begin());
  votes_ = {};
  for (Packet& one : std::exchange(held_, {})) MDOF_CHECK(place(std::move(one), placed));
  return {};
}

void FrameCounter::vote(const Packet& before, const Packet& packet) {
  const auto counted = static_cast<std::uint32_t>(moved(before, packet));
  for (int unit = 0; unit < kCounterUnits; ++unit)
    if (counted == step(before, static_cast<CounterUnit>(unit)))
      ++votes_[static_cast<std::size_t>(unit)];
}

Status FrameCounter::place(Packet packet, std::deque<PlacedPacket>& placed) {
  PlacedPacket next;
  if (last_) {
    const auto counted = static_cast<std::uint32_t>(moved(last_->packet, packet));
    const std::uint64_t expected = step(last_->packet, *unit_);
    if (counted < expected) return jumped(last_->packet, packet);
    const double lost = frames(counted - expected, last_->packet);
    if (lost > static_cast<double>(most_lost_)) return jumped(last_->packet, packet);
    // At least one whole frame is lost. Therefore the number is rounded up.
    next.lost = static_cast<std::uint64_t>(lost + 0.999);
    next.first_frame =
        last_->first_frame + last_->packet.frames() + static_cast<std::int64_t>(next.lost);
  }
  lost_ += next.lost;
  if (!last_) last_.emplace();
  last_->packet = packet;  // reuses the memory of the previous packet
  last_->first_frame = next.first_frame;
  next.packet = std::move(packet);
  placed.push_back(std::move(next));
  return {};
}

bool FrameCounter::is_duplicate(const Packet& last, const Packet& packet) const {
  return moved(last, packet) <= 0;
}

Status FrameCounter::drop_duplicate(const Packet& last, const Packet& packet) {
  const auto back = -static_cast<std::int64_t>(moved(last, packet));
  const auto per_packet = static_cast<std::int64_t>(
      std::max(step(last, CounterUnit::value), step(last, CounterUnit::sample)));
  if (back > kMostDuplicates * per_packet || ++duplicates_in_a_row_ > kMostDuplicates)
    return jumped(last, packet);
  ++duplicates_;
  return {};
}

}  // namespace mdof::drivers::capancdt
