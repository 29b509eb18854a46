#include "algo/straightness.h"

#include <algorithm>
#include <cmath>

#include "algo/line_fit.h"
#include "algo/series.h"
#include "algo/usable_runs.h"

namespace mdof::algo {
namespace {

constexpr Approach kApproaches[] = {Approach::forward, Approach::reverse, Approach::both};

StraightnessFigure figure_of(const ErrorName& name, std::size_t index, Approach approach,
                             const std::vector<TargetMean>& series) {
  const auto x = positions(series), y = column(series, index);
  const Line fitted = least_squares_line(x, y);
  const Line ends = end_point_line(x, y);
  const Deviations from_fitted = deviations_from(fitted, x, y);
  StraightnessFigure f;
  f.error_key = name.key;
  f.approach = to_string(approach);
  f.slope_least_squares_rad = fitted.slope;
  f.u_slope_least_squares_rad = fitted.u_slope;
  f.slope_end_point_rad = ends.slope;
  f.straightness_least_squares_m = from_fitted.peak_to_valley;
  f.straightness_end_point_m = deviations_from(ends, x, y).peak_to_valley;
  f.peak_position_m = x[from_fitted.peak];
  f.valley_position_m = x[from_fitted.valley];
  return f;
}

Status check_axis(const Run& run, Axis axis) {
  if (run.header.axis == axis) return {};
  return bad_input("run " + std::to_string(run.header.id) + " is of axis " +
                   letter(run.header.axis) + ", squareness needs the run of " + letter(axis) +
                   " in this place: squareness RUN_X RUN_Y");
}

// Slope of the horizontal straightness, EYX for X and EXY for Y: the first named error of both.
Result<Line> horizontal_slope(const Run& run, Axis axis) {
  const std::string name = "run " + std::to_string(run.header.id);
  const auto series = target_means(axis, run.points, Approach::both);
  const auto x = positions(series);
  if (series.size() < 3 || !can_fit(x)) {
    return bad_input(name + " has " + std::to_string(series.size()) +
                     " solved targets; a line with its uncertainty needs at least three");
  }
  return least_squares_line(x, column(series, 0));
}

}  // namespace

std::vector<StraightnessFigure> straightness(Axis axis, const std::vector<MeasuredPoint>& points) {
  std::vector<StraightnessFigure> figures;
  for (const Approach approach : kApproaches) {
    const auto series = target_means(axis, points, approach);
    if (series.size() < 3 || !can_fit(positions(series))) continue;
    for (std::size_t k = 0; k < 5; ++k) {
      const ErrorName& name = error_names(axis)[k];
      if (!name.angle) figures.push_back(figure_of(name, k, approach, series));
    }
  }
  return figures;
}

std::vector<AngleFigure> angles(Axis axis, const std::vector<MeasuredPoint>& points) {
  std::vector<AngleFigure> figures;
  for (const Approach approach : kApproaches) {
    const auto series = target_means(axis, points, approach);
    if (series.size() < 2) continue;
    for (std::size_t k = 0; k < 5; ++k) {
      const ErrorName& name = error_names(axis)[k];
      if (!name.angle) continue;
      const auto y = column(series, k);
      const auto [low, high] = std::minmax_element(y.begin(), y.end());
      figures.push_back(
          {name.key, to_string(approach), y.front(), *low - y.front(), *high - y.front()});
    }
  }
  return figures;
}

Result<Squareness> squareness(const Run& run_x, const Run& run_y, double artefact_angle_error_rad,
                              double u_artefact_rad, bool take_partial) {
  MDOF_CHECK(check_axis(run_x, Axis::x));
  MDOF_CHECK(check_axis(run_y, Axis::y));
  MDOF_CHECK(check_usable({&run_x, &run_y}, take_partial, "squareness"));
  MDOF_TRY(const Line along_x, horizontal_slope(run_x, Axis::x));
  MDOF_TRY(const Line along_y, horizontal_slope(run_y, Axis::y));
  Squareness s;
  s.run_x = run_x.header.id;
  s.run_y = run_y.header.id;
  s.slope_EYX_rad = along_x.slope;
  s.u_slope_EYX_rad = along_x.u_slope;
  s.slope_EXY_rad = along_y.slope;
  s.u_slope_EXY_rad = along_y.u_slope;
  s.artefact_angle_error_rad = artefact_angle_error_rad;
  s.EC0Y_rad = -along_y.slope - along_x.slope - artefact_angle_error_rad;
  s.u_EC0Y_rad = std::sqrt(along_x.u_slope * along_x.u_slope + along_y.u_slope * along_y.u_slope +
                           u_artefact_rad * u_artefact_rad);
  s.simulated = run_x.header.simulated || run_y.header.simulated;
  return s;
}

}  // namespace mdof::algo
