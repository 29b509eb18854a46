#include "algo/trend/control_chart.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kMeanRangeBySd = 1.128;  // d2: mean range of two values, in units of their sd
constexpr double kLimits = 3;

struct Part {
  double mean = 0, square = 0, u2 = 0, n = 0;  // square: sum of squares about the mean; u2: Σ u²
};

Part part_of(const std::vector<ChartValue>& values, std::size_t begin, std::size_t end) {
  Part part;
  for (std::size_t i = begin; i < end; ++i) {
    part.n += 1;
    const double off = values[i].value - part.mean;
    part.mean += off / part.n;
    part.square += off * (values[i].value - part.mean);
    part.u2 += values[i].u * values[i].u;
  }
  return part;
}

Chart::Moved find_moved_mean(const std::vector<ChartValue>& values, double sigma) {
  Chart::Moved moved;
  double least = 0;
  for (std::size_t at = 1; at < values.size(); ++at) {
    const Part before = part_of(values, 0, at), after = part_of(values, at, values.size());
    if (at > 1 && before.square + after.square >= least) continue;
    least = before.square + after.square;
    const double by_sigma = sigma * std::sqrt(1 / before.n + 1 / after.n);
    const double by_u =
        std::sqrt(before.u2 / (before.n * before.n) + after.u2 / (after.n * after.n));
    moved = {at, after.mean - before.mean, std::max(by_sigma, by_u)};
  }
  return moved;
}

}  // namespace

std::optional<Chart> control_chart(const std::vector<ChartValue>& values, std::size_t baseline) {
  Chart chart;
  chart.baseline = baseline > 0 ? baseline : values.size() - (values.empty() ? 0 : 1);
  if (chart.baseline < kLeastBaselineValues || chart.baseline > values.size()) return std::nullopt;
  chart.centre = part_of(values, 0, chart.baseline).mean;
  double ranges = 0;
  for (std::size_t i = 1; i < chart.baseline; ++i)
    ranges += std::abs(values[i].value - values[i - 1].value);
  chart.sigma = ranges / static_cast<double>(chart.baseline - 1) / kMeanRangeBySd;
  std::size_t in_a_row = 0;
  int side = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double reach = kLimits * std::max(chart.sigma, values[i].u);
    chart.low.push_back(chart.centre - reach);
    chart.high.push_back(chart.centre + reach);
    const double off = values[i].value - chart.centre;
    if (std::abs(off) > reach) chart.outside.push_back(i);
    const int here = off > 0 ? 1 : off < 0 ? -1 : 0;
    in_a_row = here != 0 && here == side ? in_a_row + 1 : (here != 0 ? 1 : 0);
    side = here;
    if (in_a_row >= kOneSideRunLength) chart.one_side.push_back(i);
  }
  const auto last_is = [&](const std::vector<std::size_t>& signals) {
    return !signals.empty() && signals.back() + 1 == values.size();
  };
  if (last_is(chart.outside) || last_is(chart.one_side))
    chart.moved = find_moved_mean(values, chart.sigma);
  return chart;
}

}  // namespace mdof::algo
