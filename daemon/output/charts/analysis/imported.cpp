// The chart of an imported run: the readings of another instrument, and the means of ISO 230-2 if
// there are enough readings.
#include "algo/iso230/positioning/positioning.h"
#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/run/points.h"
#include "schema/imported/series.h"
#include "schema/recording/run_options.h"

namespace mdof::charts {

using output::Language;
using output::Phrase;
using output::phrase;

namespace {

// The sign convention of the readings, with the keys of JSON and CSV. Without this text the chart
// would not state its sign convention.
std::string sense_of(const RunHeader& run) {
  if (run.provenance.model != positioning_name(run.axis)) return "";
  const ImportedSense stated = run_options(run).imported;
  return std::string(", positioning_sense: ") + to_string(stated.sense) +
         (stated.against_command ? std::string(", travel: ") + (*stated.against_command ? "-" : "+")
                                 : "");
}

}  // namespace

RunCharts imported_run_charts(const Run& run, Language language) {
  RunCharts all;
  const ImportedError error = imported_run_error(run.header);
  PositioningSeries series{error.key(), {}, {}};
  for (const MeasuredPoint& p : run.points)
    series.readings.push_back({p.target_m, p.point.direction, p.run, deviation(p)});
  const std::string name = "run-" + std::to_string(run.header.id);
  auto figures = algo::positioning(series.readings);
  if (figures)
    series.figures = std::move(*figures);
  else
    all.left_out.push_back(
        name + ": the means of ISO 230-2 cannot be calculated: " + figures.error().message);
  PositioningPicture picture;
  picture.title = run_title(run.header, phrase(Phrase::positioning_of_run, language), language);
  picture.about = about_run(run.header, language) + sense_of(run.header);
  picture.warnings = daemon::warning_marks(run, language);
  picture.series = {std::move(series)};
  all.charts.push_back({name + "-" + error.name + ".svg", positioning_svg(picture, language)});
  return all;
}

}  // namespace mdof::charts
