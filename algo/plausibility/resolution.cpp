#include "algo/plausibility/resolution.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

// Largest ratio of steps that count as equal; readings with few digits have slightly different
// steps.
constexpr double kAlike = 1.05;
constexpr std::size_t kFewest = 3;
constexpr double kNoiseWithoutRounding =
    0.5;  // with this sd, in steps, the mean has no rounding error

}  // namespace

void Resolution::add(std::span<const double> x) {
  if (x.size() < 4 || x[0] != x[1]) return;  // usual case: the noise is larger than the step
  for (std::size_t i = 1; i + 2 < x.size(); ++i) {
    if (x[i - 1] == x[i] && x[i] != x[i + 1] && x[i + 1] == x[i + 2])
      keep(std::abs(x[i + 1] - x[i]));
  }
}

void Resolution::keep(double step) {
  if (!std::isfinite(step) || (kept_ == kKept && step >= smallest_.back())) return;
  if (kept_ < kKept) ++kept_;
  std::size_t i = kept_ - 1;
  for (; i > 0 && smallest_[i - 1] > step; --i) smallest_[i] = smallest_[i - 1];
  smallest_[i] = step;
  // Three quarters of the steps must agree if there are fewer than 16 steps, otherwise an eighth of
  // them; at least kFewest in both cases. A single step is thus not taken as the resolution.
  const std::size_t alike = std::max(kFewest, kept_ < 16 ? kept_ * 3 / 4 : kept_ / 8);
  step_ = 0;
  for (std::size_t k = 0; k + alike <= kept_ && step_ == 0; ++k) {
    if (smallest_[k + alike - 1] <= kAlike * smallest_[k]) step_ = smallest_[k];
  }
}

// The result must depend on the values of probe_is_new in these rows, and not on the existence of
// this column. Any row of a block can add the column, and a replay divides the rows into other
// blocks than the live run.
void ProbeResolution::add(const FrameBlock& frames, std::size_t first, std::size_t last) {
  for (std::size_t k = 0; k < found_.size(); ++k) {
    Found& probe = found_[k];
    if (k < frames.probe_is_new.size() && !frames.probe_is_new[k].empty()) {
      const auto fresh = std::span(frames.probe_is_new[k]).subspan(first, last - first);
      probe.is_slow = probe.is_slow || std::find(fresh.begin(), fresh.end(), 0) != fresh.end();
    }
    if (!probe.is_slow)
      probe.resolution.add(std::span(frames.probe_m[k]).subspan(first, last - first));
  }
}

double with_resolution(double u, double sd, double step) {
  if (sd >= kNoiseWithoutRounding * step) return u;
  return std::sqrt(u * u + step * step / 12);
}

}  // namespace mdof::algo
