#include "algo/iso230/straightness.h"

#include <algorithm>
#include <cmath>

#include "algo/iso230/line_fit.h"
#include "algo/iso230/reference_lines.h"
#include "algo/iso230/target_means.h"

namespace mdof::algo {
namespace {

constexpr Approach kApproaches[] = {Approach::forward, Approach::reverse, Approach::both};

StraightnessFigure figure_of(const MovingAxis& moving, std::size_t index, Approach approach,
                             const std::vector<TargetMean>& series) {
  const auto x = own_travels(moving.sides, series), y = column(series, index);
  const Line fitted = least_squares_line(x, y);
  const Line ends = end_point_line(x, y);
  const Deviations from_fitted = deviations_from(fitted, x, y);
  StraightnessFigure f;
  f.error_key = error_names(moving.axis)[index].key;
  f.approach = to_string(approach);
  f.slope_least_squares_rad = fitted.slope;
  f.form_rad = fitted.u_slope;
  f.slope_end_point_rad = ends.slope;
  f.straightness_least_squares_m = from_fitted.peak_to_valley;
  f.straightness_end_point_m = deviations_from(ends, x, y).peak_to_valley;
  f.peak_position_m = series[from_fitted.peak].position_m;
  f.valley_position_m = series[from_fitted.valley].position_m;
  return f;
}

}  // namespace

std::vector<StraightnessFigure> straightness(const MovingAxis& moving,
                                             const std::vector<MeasuredPoint>& points) {
  std::vector<StraightnessFigure> figures;
  for (const Approach approach : kApproaches) {
    const auto series = target_means(moving, points, approach);
    if (series.size() < 3 || !can_fit(positions(series))) continue;
    for (std::size_t k = 0; k < 5; ++k) {
      if (!error_names(moving.axis)[k].angle)
        figures.push_back(figure_of(moving, k, approach, series));
    }
  }
  return figures;
}

std::vector<StraightnessLines> straightness_lines(const MovingAxis& moving,
                                                  const std::vector<MeasuredPoint>& points) {
  std::vector<StraightnessLines> found;
  for (const Approach approach : kApproaches) {
    const auto series = target_means(moving, points, approach);
    for (std::size_t k = 0; k < 5; ++k) {
      const ErrorName& name = error_names(moving.axis)[k];
      if (name.angle) continue;
      const auto lines = reference_lines(own_travels(moving.sides, series), column(series, k));
      if (lines) found.push_back({name.key, to_string(approach), *lines});
    }
  }
  return found;
}

std::vector<AngleFigure> angles(const MovingAxis& moving,
                                const std::vector<MeasuredPoint>& points) {
  std::vector<AngleFigure> figures;
  for (const Approach approach : kApproaches) {
    const auto series = target_means(moving, points, approach);
    if (series.size() < 2) continue;
    for (std::size_t k = 0; k < 5; ++k) {
      const ErrorName& name = error_names(moving.axis)[k];
      if (!name.angle) continue;
      const auto y = column(series, k);
      const auto [low, high] = std::minmax_element(y.begin(), y.end());
      figures.push_back(
          {name.key, to_string(approach), y.front(), *low - y.front(), *high - y.front()});
    }
  }
  return figures;
}

}  // namespace mdof::algo
