#include "algo/iso230/squareness_lines.h"

#include "algo/iso230/reference_lines.h"
#include "algo/iso230/target_means.h"
#include "algo/model/restate.h"

namespace mdof::algo {
namespace {

Result<ReferenceLines> lines_along(const Run& measured, Axis other) {
  const Run run = restate(measured, kAtFixture);
  const auto series = target_means(run.header.moving(), run.points, Approach::both);
  auto lines = reference_lines(own_travels(run.header.sides, series),
                               column(series, straightness_along(run.header.axis, other)));
  if (!lines) return in_context("run " + std::to_string(run.header.id), std::move(lines.error()));
  return lines;
}

SquarenessLine lines_squareness(const ReferenceLine& a, const ReferenceLine& b,
                                const Squareness& fitted) {
  return {
      a.slope_rad, b.slope_rad,
      squareness_of(fitted.axes, a.slope_rad, b.slope_rad, fitted.artefact) + fitted.tilt_rad()};
}

}  // namespace

Result<SquarenessByLine> squareness_lines(const Run& run_a, const Run& run_b,
                                          const Squareness& fitted) {
  MDOF_TRY(const ReferenceLines a, lines_along(run_a, fitted.axes.b));
  MDOF_TRY(const ReferenceLines b, lines_along(run_b, fitted.axes.a));
  return SquarenessByLine{lines_squareness(a.end_point, b.end_point, fitted),
                          {fitted.slope_a_rad, fitted.slope_b_rad, fitted.error_rad},
                          lines_squareness(a.minimum_zone, b.minimum_zone, fitted)};
}

}  // namespace mdof::algo
