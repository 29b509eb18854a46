#include "algo/iso230/positioning/run_readings.h"

#include "algo/iso230/line_fit.h"
#include "algo/iso230/target_means.h"

namespace mdof::algo {
namespace {

// Returns the line to subtract. With fewer than three positions it is 0, because two points are
// always on a line.
Line line_of_run(const Run& run, std::size_t named) {
  const auto series = target_means(run.header.moving(), run.points, Approach::both);
  const auto x = positions(series);
  return can_fit(x) ? least_squares_line(x, column(series, named)) : Line{};
}

}  // namespace

RunReadings readings_of_run(const Run& run, std::size_t named, bool keep_slope) {
  const bool as_it_is = keep_slope || error_names(run.header.axis)[named].angle;
  const Line line = as_it_is ? Line{} : line_of_run(run, named);
  RunReadings found;
  for (const MeasuredPoint& p : run.points) {
    if (!p.errors.valid || p.point.direction == 0) {
      ++found.left_out;
      continue;
    }
    const double error = named_from_local(run.header.moving(), p.errors.local)[named];
    found.readings.push_back(
        {p.target_m, p.point.direction, p.run, error - line.at(p.point.position_m)});
  }
  return found;
}

}  // namespace mdof::algo
