#include "algo/drift/warm_up.h"

#include <algorithm>
#include <cmath>

namespace mdof::algo {
namespace {

constexpr double kCoverage = 2;
constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

struct Line {
  double n = 0, xx = 0, xy = 0, yy = 0;  // sums about the means
  double slope() const { return xx > 0 ? xy / xx : kNothing; }
};

// Returns the line through the steps of [begin, end) at which both x and y have a value.
template <class X>
Line line_of(const std::vector<double>& y, X x, std::size_t begin, std::size_t end) {
  Line line;
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = begin; i < end; ++i) {
    if (std::isnan(y[i]) || std::isnan(x(i))) continue;
    line.n += 1;
    const double dx = x(i) - mean_x, dy = y[i] - mean_y;
    mean_x += dx / line.n;
    mean_y += dy / line.n;
    line.xx += dx * (x(i) - mean_x);
    line.xy += dx * (y[i] - mean_y);
    line.yy += dy * (y[i] - mean_y);
  }
  return line;
}

DriftVerdict verdict_of(double rate, double u, double limit) {
  if (std::abs(rate) + kCoverage * u <= limit) return DriftVerdict::below;
  return std::abs(rate) - kCoverage * u > limit ? DriftVerdict::above : DriftVerdict::undecided;
}

bool never_changes(const ParkedSeries& series) {
  double first = kNothing;
  for (const double x : series.value) {
    if (std::isnan(x)) continue;
    if (std::isnan(first)) first = x;
    if (x != first) return false;
  }
  return true;
}

DriftWindow window_of(const ParkedSeries& series, double step_s, std::size_t begin) {
  const auto time_s = [&](std::size_t i) { return static_cast<double>(i - begin) * step_s; };
  const Line line = line_of(series.value, time_s, begin, begin + kStepsOfWindow);
  if (line.n < static_cast<double>(kFewestSteps))
    return {kNothing, kNothing, DriftVerdict::unknown};
  const double left = std::max(0.0, line.yy - line.xy * line.slope());
  const double u = std::sqrt(left / (line.n - 2) / line.xx);
  return {line.slope(), u, verdict_of(line.slope(), u, series.limit_per_s)};
}

TemperatureDependence with_temperature(const ParkedReadings& readings, const ParkedSeries& series) {
  const Line line = line_of(
      series.value, [&](std::size_t i) { return readings.temperature_C[i]; }, 0,
      series.value.size());
  if (!(line.xx > 0 && line.yy > 0)) return {kNothing, kNothing};
  return {line.slope(), line.xy / std::sqrt(line.xx * line.yy)};
}

std::optional<double> ready_after(const ParkedReadings& readings, const WarmUp& found) {
  std::size_t first = 0;
  for (std::size_t s = 0; s < readings.series.size(); ++s) {
    if (std::isinf(readings.series[s].limit_per_s)) continue;
    for (std::size_t w = 0; w < found.begin_s.size(); ++w)
      if (found.windows[s][w].verdict != DriftVerdict::below) first = std::max(first, w + 1);
  }
  if (!found.limited || first + kFewestBelow > found.begin_s.size()) return std::nullopt;
  const double below_s = static_cast<double>(found.begin_s.size() - first) * found.window_s;
  if (below_s < kShortestBelow_s) return std::nullopt;
  return found.begin_s[first];
}

}  // namespace

const char* to_string(DriftVerdict verdict) {
  switch (verdict) {
    case DriftVerdict::below:
      return "below";
    case DriftVerdict::above:
      return "above";
    case DriftVerdict::undecided:
      return "undecided";
    case DriftVerdict::unknown:
      break;
  }
  return "unknown";
}

WarmUp warm_up(const ParkedReadings& readings) {
  WarmUp found;
  found.window_s = readings.step_s * static_cast<double>(kStepsOfWindow);
  const std::size_t steps = readings.series.empty() ? 0 : readings.series.front().value.size();
  for (std::size_t begin = 0; begin + kStepsOfWindow <= steps; begin += kStepsOfWindow)
    found.begin_s.push_back(static_cast<double>(begin) * readings.step_s);
  for (const ParkedSeries& series : readings.series) {
    auto& windows = found.windows.emplace_back();
    const bool constant = never_changes(series);
    for (std::size_t w = 0; w < found.begin_s.size(); ++w) {
      windows.push_back(window_of(series, readings.step_s, w * kStepsOfWindow));
      if (constant) windows.back().verdict = DriftVerdict::unknown;
    }
    found.limited = found.limited || !std::isinf(series.limit_per_s);
    if (!readings.temperature_C.empty())
      found.with_temperature.push_back(with_temperature(readings, series));
  }
  found.ready_after_s = ready_after(readings, found);
  return found;
}

}  // namespace mdof::algo
