#include "schema/targets.h"

#include <algorithm>
#include <cmath>

#include "schema/base/random.h"

namespace mdof {
namespace {

constexpr double kMostTargets = 10'000;
constexpr double kAlike = 0.01;  // largest distance from a whole number of periods

bool whole_periods(double interval_mm, double period_mm) {
  const double periods = interval_mm / period_mm;
  return periods > 0.5 && std::abs(periods - std::floor(periods + 0.5)) < kAlike;
}

}  // namespace

std::optional<WrongKey> check_spacing(const TargetSpacing& s) {
  if (!(s.to_mm > s.from_mm)) return WrongKey{"to_mm", "must be greater than from_mm"};
  if (!(s.interval_mm > 0)) return WrongKey{"interval_mm", "must be greater than zero"};
  if (!((s.to_mm - s.from_mm) / s.interval_mm < kMostTargets))
    return WrongKey{"interval_mm", "gives more than 10000 targets; give a larger interval"};
  if (!(s.jitter_mm >= 0 && s.jitter_mm < s.interval_mm / 2))
    return WrongKey{"jitter_mm", "must be 0 or greater, and less than half of interval_mm"};
  return std::nullopt;
}

std::vector<double> spaced_targets_mm(const TargetSpacing& s) {
  constexpr std::uint32_t kPurpose = 0x7A46;
  std::vector<double> targets_mm;
  const double count = std::floor((s.to_mm - s.from_mm) / s.interval_mm + 1e-9) + 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Philox random = philox({i, 0, 0, kPurpose}, static_cast<std::uint64_t>(s.seed));
    const double offset_mm = s.jitter_mm * (2 * uniform(random[0], random[1]) - 1);
    const double even_mm = s.from_mm + i * s.interval_mm, shifted_mm = even_mm + offset_mm;
    // A shift beyond the first or last position is mirrored, because the limit of the axis may be
    // there.
    const bool is_within = shifted_mm >= s.from_mm && shifted_mm <= s.to_mm;
    targets_mm.push_back(is_within ? shifted_mm : std::min(even_mm - offset_mm, s.to_mm));
  }
  return targets_mm;
}

std::optional<Notice> scale_period_notice(const std::vector<double>& targets_mm,
                                          double scale_period_um) {
  if (!(scale_period_um > 0) || targets_mm.size() < 2) return std::nullopt;
  for (std::size_t i = 1; i < targets_mm.size(); ++i)
    if (!whole_periods(targets_mm[i] - targets_mm[i - 1], scale_period_um * 1e-3))
      return std::nullopt;
  return notice(NoticeCode::scale_period_hidden, "", {{"period_um", scale_period_um}});
}

}  // namespace mdof
