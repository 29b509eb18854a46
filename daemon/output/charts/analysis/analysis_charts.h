// Charts of analyses. Each chart has a function that takes results and returns an SVG document.
// Pure: equal results make equal bytes. Each drawn element has its numbers in data-… attributes, in
// the units of the result documents.
#pragma once

#include <string>
#include <vector>

#include "algo/drift/warm_up.h"
#include "daemon/measure/replay/parked_log.h"
#include "daemon/measure/several_runs/comparison.h"
#include "daemon/output/charts/run/run_charts.h"
#include "daemon/output/phrases.h"
#include "schema/iso230/positioning.h"
#include "schema/iso230/reference_lines.h"

namespace mdof::charts {

// The change "after - before" of each error at each target and approach, in µm or µrad, against the
// position in mm. Bands show U of the change; U assumes that the two runs are independent.
// has_comparison() is false if the runs have no common target.
bool has_comparison(const daemon::Comparison& comparison);
std::string comparison_svg(const daemon::Comparison& comparison, output::Language language);

// Readings of a test to ISO 230-2, the mean of each approach with ± 2 s (s: standard deviation of
// the readings), and the mean of both approaches.
struct PositioningSeries {
  std::string key;  // "EYX_um"
  Positioning figures;
  std::vector<PositioningReading> readings;
};
struct PositioningPicture {
  std::string title, about;
  std::vector<std::string> warnings;
  std::vector<PositioningSeries> series;  // at least one
};
std::string positioning_svg(const PositioningPicture& picture, output::Language language);

// The readings of an imported run, with the means of ISO 230-2 if there are enough readings to
// calculate them.
RunCharts imported_run_charts(const Run& run, output::Language language);

// Deviations from a straight line against the position, both in m. The chart shows each reference
// line and the residuals from the least-squares line.
struct StraightnessPicture {
  std::string about;
  std::vector<std::string> warnings;
  std::vector<double> position_m, deviation_m;
  ReferenceLines lines;
};
std::string reference_lines_svg(const StraightnessPicture& picture, output::Language language);

// Drift rates of a parked axis, one for each time window, in nm/h or µrad/h, against the time in
// min. The chart shows u of each rate, and the limits.
std::string warm_up_svg(const daemon::ParkedLog& log, const algo::WarmUp& found,
                        output::Language language);

}  // namespace mdof::charts
