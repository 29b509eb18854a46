#include "algo/part/true_scale.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

std::ptrdiff_t count_below(const std::vector<double>& sorted, double s) {
  return std::lower_bound(sorted.begin(), sorted.end(), s) - sorted.begin();
}

std::ptrdiff_t count_up_to(const std::vector<double>& sorted, double s) {
  return std::upper_bound(sorted.begin(), sorted.end(), s) - sorted.begin();
}

}  // namespace

ScaleRange possible_scales(const std::vector<double>& value, const std::vector<double>& error,
                           std::size_t width, std::size_t within, double most_m) {
  std::vector<double> begins, ends;
  double all_vv = 0, all_ve = 0;
  auto missing = static_cast<std::ptrdiff_t>(within);
  for (std::size_t k = 0; k < value.size(); k += width) {
    double vv = 0, ve = 0, ee = 0;
    for (std::size_t i = k; i < k + width; ++i) {
      vv += value[i] * value[i];
      ve += value[i] * error[i];
      ee += error[i] * error[i];
    }
    all_vv += vv;
    all_ve += ve;
    const double root = ve * ve - vv * (ee - most_m * most_m);
    if (vv == 0 && ee <= most_m * most_m) --missing;
    if (vv == 0 || root < 0) continue;
    begins.push_back((-ve - std::sqrt(root)) / vv);
    ends.push_back((-ve + std::sqrt(root)) / vv);
  }
  std::sort(begins.begin(), begins.end());
  std::sort(ends.begin(), ends.end());
  const auto is_possible = [&](double s) {
    return count_up_to(begins, s) - count_below(ends, s) >= missing;
  };
  const auto first = std::find_if(begins.begin(), begins.end(), is_possible);
  const auto last = std::find_if(ends.rbegin(), ends.rend(), is_possible);
  if (first != begins.end() && last != ends.rend())
    return {std::max(0.0, *first), std::max(0.0, *last)};
  const double least = all_vv > 0 ? std::max(0.0, -all_ve / all_vv) : 0;
  return {least, least};
}

std::vector<double> drawn_scales(const std::vector<ScaleRange>& ranges) {
  std::vector<double> lows, highs, found;
  for (const ScaleRange& range : ranges) {
    lows.push_back(range.low);
    highs.push_back(range.high);
  }
  std::sort(lows.begin(), lows.end());
  std::sort(highs.begin(), highs.end());
  const auto trials = static_cast<std::ptrdiff_t>(ranges.size());
  for (const double s : highs) {
    const auto exceed = count_up_to(highs, s) + trials - count_up_to(lows, s);
    while (std::ssize(found) < std::min(exceed, trials)) found.push_back(s);
  }
  return found;
}

double lower_scale(const std::vector<double>& scales, std::size_t k, double value_m,
                   double always_m) {
  const double twice = scales[std::min(2 * k + 1, scales.size() - 1)];
  if (twice * value_m <= always_m) return twice;
  return std::max(scales[k], always_m / value_m);
}

}  // namespace mdof::algo
