#include "algo/sequence/shifted_targets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace mdof::algo {
namespace {

constexpr std::size_t kFewestTargets = 3;
constexpr double kAlike_m = 50e-6;
constexpr std::size_t kNever = std::numeric_limits<std::size_t>::max();

using Places = std::vector<double>;

std::size_t index_of(const MeasuredPoint& point) {
  return static_cast<std::size_t>(point.target) - 1;
}

// Returns the index of the last point of each target; kNever: the target has no point.
std::vector<std::size_t> last_visits(const Sequence& sequence) {
  std::vector<std::size_t> last(sequence.targets_m.size(), kNever);
  for (std::size_t i = 0; i < sequence.points.size(); ++i) last[index_of(sequence.points[i])] = i;
  return last;
}

// Returns the targets whose last visit is before point `split`, and the other visited targets, both
// ascending. If no target has visits before and after `split`, these are the targets before and
// after `split`.
std::pair<Places, Places> split_targets(const Sequence& sequence,
                                        const std::vector<std::size_t>& last, std::size_t split) {
  std::pair<Places, Places> places;
  for (std::size_t t = 0; t < last.size(); ++t)
    if (last[t] != kNever)
      (last[t] < split ? places.first : places.second).push_back(sequence.targets_m[t]);
  return places;
}

// Returns the shift from `before` to `after` if the same shift applies to all targets of the
// smaller list.
std::optional<double> shift_between(const Places& before, const Places& after) {
  const std::size_t n = std::min(before.size(), after.size());
  if (n < kFewestTargets) return {};
  for (std::size_t i = 0; i + n <= before.size(); ++i) {
    for (std::size_t j = 0; j + n <= after.size(); ++j) {
      const double shift = after[j] - before[i];
      bool alike = std::abs(shift) < 0.5 * (before[i + n - 1] - before[i]);
      for (std::size_t k = 1; alike && k < n; ++k)
        alike = std::abs(after[j + k] - before[i + k] - shift) < kAlike_m;
      if (alike) return shift;
    }
  }
  return {};
}

}  // namespace

std::optional<ShiftedTargets> find_shifted_targets(const Sequence& sequence) {
  const auto last = last_visits(sequence);
  std::size_t still_visited = 0;  // last visit of any target that has a visit before `split`
  for (std::size_t split = 1; split < sequence.points.size(); ++split) {
    const MeasuredPoint& newest = sequence.points[split - 1];
    still_visited = std::max(still_visited, last[index_of(newest)]);
    if (still_visited >= split) continue;
    const auto [before, after] = split_targets(sequence, last, split);
    if (const auto shift = shift_between(before, after))
      return ShiftedTargets{newest.point.end_ns, *shift};
  }
  return {};
}

}  // namespace mdof::algo
