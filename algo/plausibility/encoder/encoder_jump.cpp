#include "algo/plausibility/encoder/encoder_jump.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr std::size_t kReach =
    5;  // step_at() uses at most this number of rows before and after row i
constexpr double kGreatest_m_s2 = 10;

double middle(double a, double b, double c) {
  return std::max(std::min(a, b), std::min(std::max(a, b), c));
}

// Returns the speed in m per scan from four rows. It is the median of their three steps, so a jump
// between two rows and a spike in one row do not change it.
double speed_from(std::span<const double> x, std::size_t first) {
  return middle(x[first + 1] - x[first], x[first + 2] - x[first + 1], x[first + 3] - x[first + 2]);
}

// Returns the median of the positions in a row and in the two rows next to it, after subtraction of
// the motion of the axis between these rows. The median removes a spike of one scan and does not
// change the size of a jump in either direction of motion.
double voted(std::span<const double> x, std::size_t i, double speed) {
  return middle(x[i - 1] + speed, x[i], x[i + 1] - speed);
}

struct Step {
  double size = 0, speed = 0, speed_change = 0;  // m, m per scan, m per scan
};

// Returns the step from i - 1 to i after subtraction of the motion of the axis.
Step step_at(std::span<const double> x, std::size_t i) {
  const double speed_before = speed_from(x, i - 4), speed_after = speed_from(x, i);
  const double last = voted(x, i - 1, speed_before), next = voted(x, i, speed_after);
  const double before = (last - voted(x, i - 4, speed_before)) / 3;
  const double after = (voted(x, i + 3, speed_after) - next) / 3;
  const double speed = 0.5 * (before + after);
  return {next - last - speed, speed, after - before};
}

// Subtracts the motion of the axis during scans that are not in the log, from the step between the
// two rows next to these scans. If the speed changes, this motion is not known exactly, and the
// returned size is the smallest possible.
double without_lost_scans(const Step& step, double lost) {
  const double size = step.size - lost * step.speed;
  const double unknown = std::min(std::abs(size), lost * std::abs(step.speed_change));
  return size - std::copysign(unknown, size);
}

}  // namespace

std::optional<EncoderJump> find_jump(std::span<const std::int64_t> time_ns,
                                     std::span<const double> encoder_m, std::size_t first,
                                     std::size_t last, std::int64_t period_ns, double least_m) {
  std::optional<EncoderJump> largest;
  const double period_s = 1e-9 * static_cast<double>(period_ns);
  for (std::size_t i = std::max(first, kReach + 1); i < last && i + kReach + 1 < encoder_m.size();
       ++i) {
    const Step step = step_at(encoder_m, i);
    const double size = std::abs(step.size);
    if (!(size > least_m) || 4 * size < kGreatest_m_s2 * period_s * period_s) continue;
    if (size < 3 * std::abs(step.speed_change)) continue;
    // If the axis itself moves this fast, the rows next to this row have similar steps.
    const double beside = std::max(std::abs(step_at(encoder_m, i - 1).size),
                                   std::abs(step_at(encoder_m, i + 1).size));
    if (size < 4 * beside) continue;
    if (time_ns[i + 1] - time_ns[i - 2] > 6 * period_ns) continue;  // a gap
    const double interval_ns = static_cast<double>(time_ns[i] - time_ns[i - 1]);
    const double lost = std::max(0.0, std::round(interval_ns / static_cast<double>(period_ns)) - 1);
    const double jump_m = without_lost_scans(step, lost);
    if (!(std::abs(jump_m) > least_m) || (largest && std::abs(jump_m) < std::abs(largest->size_m)))
      continue;
    largest = {time_ns[i], encoder_m[i - 1], jump_m};
  }
  return largest;
}

}  // namespace mdof::algo
