#include "algo/iso230/reference_lines.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <vector>

#include "algo/iso230/line_fit.h"
#include "algo/iso230/minimum_zone.h"

namespace mdof::algo {
namespace {

// Readings sorted by position, then by deviation, so that the result does not depend on the order
// of the input.
struct Series {
  std::vector<double> x, y;
};

Series in_order(std::span<const double> x, std::span<const double> y) {
  std::vector<std::pair<double, double>> readings;
  readings.reserve(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) readings.emplace_back(x[i], y[i]);
  if (!std::is_sorted(readings.begin(), readings.end()))
    std::sort(readings.begin(), readings.end());
  Series series;
  for (const auto& [position, deviation] : readings) {
    series.x.push_back(position);
    series.y.push_back(deviation);
  }
  return series;
}

std::size_t count_positions(const std::vector<double>& x) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < x.size(); ++i) count += i == 0 || x[i] != x[i - 1];
  return count;
}

double mean_at(const Series& series, double position) {
  const auto [from, to] = std::equal_range(series.x.begin(), series.x.end(), position);
  double sum = 0;
  for (auto i = from - series.x.begin(); i < to - series.x.begin(); ++i)
    sum += series.y[static_cast<std::size_t>(i)];
  return sum / static_cast<double>(to - from);
}

Line through_ends(const Series& series) {
  const double first = series.x.front(), last = series.x.back();
  return end_point_line(std::vector{first, last},
                        std::vector{mean_at(series, first), mean_at(series, last)});
}

ReferenceLine stated(const Line& line, const Series& series) {
  double square = 0;
  for (std::size_t i = 0; i < series.x.size(); ++i) {
    const double left = series.y[i] - line.at(series.x[i]);
    square += left * left;
  }
  return {line.slope, line.intercept, deviations_from(line, series.x, series.y).peak_to_valley,
          std::sqrt(square / static_cast<double>(series.x.size()))};
}

bool is_finite(const ReferenceLine& line) {
  return std::isfinite(line.slope_rad) && std::isfinite(line.intercept_m) &&
         std::isfinite(line.zone_m) && std::isfinite(line.residual_m);
}

constexpr double kMost_m = 1e6;  // avoids overflow of products of two values

Status check_size(std::span<const double> values, const char* what) {
  if (std::all_of(values.begin(), values.end(), [](double v) { return std::abs(v) <= kMost_m; }))
    return {};
  return bad_input(
      std::string("a ") + what +
      " is not a finite number below 1000 km; check the unit, or leave out the reading");
}

}  // namespace

Result<ReferenceLines> reference_lines(std::span<const double> positions_m,
                                       std::span<const double> deviations_m) {
  assert(positions_m.size() == deviations_m.size());
  MDOF_CHECK(check_size(positions_m, "position"));
  MDOF_CHECK(check_size(deviations_m, "deviation"));
  const Series series = in_order(positions_m, deviations_m);
  ReferenceLines lines;
  lines.readings = series.x.size();
  lines.positions = count_positions(series.x);
  if (lines.positions < 3)
    return bad_input(std::to_string(lines.readings) +
                     (lines.readings == 1 ? " reading" : " readings") + " at " +
                     (lines.positions == 1 ? "only one position"
                                           : std::to_string(lines.positions) + " positions") +
                     ", but straightness needs at least three positions; "
                     "measure at more positions");
  lines.first_m = series.x.front();
  lines.last_m = series.x.back();
  lines.end_point = stated(through_ends(series), series);
  lines.least_squares = stated(least_squares_line(series.x, series.y), series);
  lines.minimum_zone = stated(minimum_zone_line(series.x, series.y), series);
  if (is_finite(lines.end_point) && is_finite(lines.least_squares) && is_finite(lines.minimum_zone))
    return lines;
  return bad_input(
      "the positions lie so close together that no slope can be calculated; check the units of the "
      "columns");
}

}  // namespace mdof::algo
