#include "algo/plausibility/slow_stretch.h"

#include <cmath>

#include "schema/units.h"

namespace mdof::algo {
namespace {

// Largest travel in one window, in tolerances; 1 mm/s with the defaults.
constexpr double kSlowTolerances = 25;

}  // namespace

std::optional<DwellEvent> SlowStretch::take(const Window& window, double tolerance_m,
                                            double least_s, double most_m) {
  if (window.range_m <= kSlowTolerances * tolerance_m) {
    if (!is_slow_) {
      is_slow_ = true;
      stood_ = false;
      begin_ns_ = window.begin_ns;
      begin_m_ = window.first_m;
    }
    stood_ = stood_ || window.still;
    return std::nullopt;
  }
  if (!is_slow_) return std::nullopt;
  is_slow_ = false;
  const double length_s = ns_to_s(window.begin_ns - begin_ns_);
  const double size_m = window.first_m - begin_m_;
  if (stood_ || length_s < least_s || std::abs(size_m) > most_m) return std::nullopt;
  return DwellEvent{DwellEventKind::creep, begin_ns_, begin_m_ + 0.5 * size_m, size_m, length_s};
}

}  // namespace mdof::algo
