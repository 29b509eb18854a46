#include "algo/uncertainty/positioning/repeatability_interval.h"

#include <algorithm>
#include <cmath>

#include "schema/sample.h"

namespace mdof::algo {
namespace {

constexpr int kHalvings = 8;  // the error of U is then below R/256

struct Group {
  double n = 0, mean = 0, s = 0;
};

std::vector<Group> groups_of(const VisitGroups& groups, const double* values) {
  std::vector<Group> all(2 * groups.targets);
  const std::size_t visits = groups.of_visit.size();
  for (std::size_t j = 0; j < visits; ++j) {
    Group& group = all[groups.of_visit[j]];
    group.n += 1;
    group.mean += values[j];
  }
  for (Group& group : all) group.mean /= group.n;
  for (std::size_t j = 0; j < visits; ++j) {
    Group& group = all[groups.of_visit[j]];
    group.s += (values[j] - group.mean) * (values[j] - group.mean);
  }
  for (Group& group : all) group.s = group.n < 2 ? kNaN : std::sqrt(group.s / (group.n - 1));
  return all;
}

}  // namespace

double repeatability_R(const VisitGroups& groups, const double* values, RepeatabilityKind of) {
  const std::vector<Group> all = groups_of(groups, values);
  double most = 0;
  for (std::size_t i = 0; i < groups.targets; ++i) {
    const Group &reverse = all[2 * i], &forward = all[2 * i + 1];
    const double both = 2 * forward.s + 2 * reverse.s + std::abs(forward.mean - reverse.mean);
    const double R = of == RepeatabilityKind::forward ? 4 * forward.s
                     : of == RepeatabilityKind::reverse
                         ? 4 * reverse.s
                         : std::max({both, 4 * forward.s, 4 * reverse.s});
    if (!std::isfinite(R)) return kNaN;
    most = std::max(most, R);
  }
  return most;
}

double repeatability_U(const VisitGroups& groups, const std::vector<double>& measured,
                       const std::vector<double>& errors, RepeatabilityKind of) {
  const double R = repeatability_R(groups, measured.data(), of);
  if (!std::isfinite(R)) return kNaN;
  const std::size_t n = measured.size();
  const auto distance = [&](double part) {
    std::vector<double> off(errors.size() / n), values(n);
    for (std::size_t t = 0; t < off.size(); ++t) {
      for (std::size_t j = 0; j < n; ++j) values[j] = part * measured[j] + errors[t * n + j];
      off[t] = std::abs(repeatability_R(groups, values.data(), of) - part * R);
    }
    const auto at =
        off.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(off.size()));
    std::nth_element(off.begin(), at, off.end());
    return *at;
  };
  const double as_measured = distance(1), distance_at_zero = distance(0);
  if (distance_at_zero >= R) return distance_at_zero;
  double low = 0, high = 1;  // limits for λ; at λ = high the measured R lies within c(T)
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = (low + high) / 2;
    (distance(middle) >= (1 - middle) * R ? high : low) = middle;
  }
  return std::max((1 - low) * R, as_measured);
}

}  // namespace mdof::algo
