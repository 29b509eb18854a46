// Charts of analyses, one function each: it takes results and returns an SVG document. Pure: the
// same results give the same bytes. Drawn elements have their numbers as data-… attributes, in the
// units of the result documents.
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

// after - before for each error, target and approach, in µm or µrad over mm, with U of the
// difference of two independent runs. has_comparison() is false if the runs have no common target.
bool has_comparison(const daemon::Comparison& comparison);
std::string comparison_svg(const daemon::Comparison& comparison, output::Language language);

// Readings of a test to ISO 230-2 with the mean of each approach, ± 2 s, and the mean of both.
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

// The readings of an imported run, with the means of ISO 230-2 if the readings give them.
RunCharts imported_run_charts(const Run& run, output::Language language);

// Deviations in m over positions in m, with each reference line and the residuals about the
// least-squares line.
struct StraightnessPicture {
  std::string about;
  std::vector<std::string> warnings;
  std::vector<double> position_m, deviation_m;
  ReferenceLines lines;
};
std::string reference_lines_svg(const StraightnessPicture& picture, output::Language language);

// Drift rates of a parked axis in each window, nm/h or µrad/h over min, with u and the limits.
std::string warm_up_svg(const daemon::ParkedLog& log, const algo::WarmUp& found,
                        output::Language language);

}  // namespace mdof::charts
