#include "algo/on_the_fly/jump_search.h"

#include <algorithm>
#include <cmath>

#include "algo/points/median.h"

namespace mdof::algo {
namespace {

constexpr std::size_t kRows = 64;   // rows that are searched together
constexpr std::size_t kStep = 8;    // rows in which at most one jump is found
constexpr std::size_t kReach = 12;  // rows before and after them that find_jump() needs
constexpr double kLeastJump_m = 20e-6, kNoises = 60;
constexpr std::int64_t kGlitch_ns = 1'000'000'000;
constexpr std::size_t kMostJumps = 1000;

std::int64_t median_step_ns(const std::vector<std::int64_t>& time_ns) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < time_ns.size(); ++i)
    steps.push_back(static_cast<double>(time_ns[i] - time_ns[i - 1]));
  return steps.empty() ? 1 : std::max<std::int64_t>(1, std::llround(median_of(std::move(steps))));
}

double mean_bend(const std::vector<double>& x) {
  double sum = 0;
  for (std::size_t i = 2; i < x.size(); ++i) sum += std::abs(x[i] - 2 * x[i - 1] + x[i - 2]);
  return sum / static_cast<double>(x.size());
}

}  // namespace

void JumpSearch::push(const FrameBlock& frames, std::size_t first, std::size_t last) {
  for (std::size_t i = first; i < last; ++i) {
    time_ns_.push_back(frames.time_ns[i]);
    encoder_m_.push_back(frames.encoder_m[i]);
    if (time_ns_.size() < kRows + 2 * kReach) continue;
    search();
    time_ns_.erase(time_ns_.begin(), time_ns_.begin() + kRows);
    encoder_m_.erase(encoder_m_.begin(), encoder_m_.begin() + kRows);
  }
}

void JumpSearch::flush() {
  search();
  time_ns_.clear();
  encoder_m_.clear();
}

void JumpSearch::search() {
  if (time_ns_.size() <= 2 * kReach) return;
  if (period_ns_ == 0) period_ns_ = median_step_ns(time_ns_);
  noise_.add(mean_bend(encoder_m_), encoder_m_.size());
  const double least_m = std::max(kLeastJump_m, kNoises * noise_.sd());
  const std::size_t end = time_ns_.size() - kReach;
  for (std::size_t i = kReach; i < end; i += kStep) {
    const auto jump =
        find_jump(time_ns_, encoder_m_, i, std::min(end, i + kStep), period_ns_, least_m);
    if (jump) take(*jump, least_m);
  }
}

// A jump that is reversed within a second is a glitch; the positions after a glitch are correct.
void JumpSearch::take(const EncoderJump& jump, double least_m) {
  const bool back = !jumps_.empty() && jump.time_ns - jumps_.back().time_ns < kGlitch_ns &&
                    std::abs(jumps_.back().size_m + jump.size_m) < 0.5 * least_m;
  if (back)
    jumps_.pop_back();
  else if (jumps_.size() < kMostJumps)
    jumps_.push_back(jump);
}

}  // namespace mdof::algo
