#include "algo/shifted_targets.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace mdof::algo {
namespace {

constexpr std::size_t kFewest = 3;
constexpr double kAlike_m = 50e-6;

using Places = std::vector<double>;

// Places of the points in [from, to), ascending; empty where one of them is visited outside, too.
Places places_of_their_own(const Sequence& sequence, std::size_t from, std::size_t to) {
  std::set<int> inside, outside;
  for (std::size_t i = 0; i < sequence.points.size(); ++i)
    (i >= from && i < to ? inside : outside).insert(sequence.points[i].target);
  Places places;
  for (const int target : inside) {
    if (outside.contains(target)) return {};
    places.push_back(sequence.targets_m[static_cast<std::size_t>(target) - 1]);
  }
  return places;
}

// What takes `before` to `after`, where one distance does for all that both have.
std::optional<double> shift_between(const Places& before, const Places& after) {
  const std::size_t n = std::min(before.size(), after.size());
  if (n < kFewest) return {};
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
  const std::size_t n = sequence.points.size();
  for (std::size_t split = kFewest; split + kFewest <= n; ++split) {
    const Places before = places_of_their_own(sequence, 0, split);
    if (before.empty()) continue;
    if (const auto shift = shift_between(before, places_of_their_own(sequence, split, n)))
      return ShiftedTargets{sequence.points[split - 1].point.end_ns, *shift};
  }
  return {};
}

}  // namespace mdof::algo
