// One function a chart of a stored run: results in, an SVG document out. Pure: the same results
// give the same bytes, and no time of making is in them. What is drawn carries its numbers, in the
// units of the result documents, as data-… attributes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "daemon/output/charts/plot_files.h"
#include "daemon/output/phrases.h"
#include "schema/compensation_table.h"
#include "schema/iso230/reference_lines.h"
#include "schema/iso230/squareness.h"
#include "schema/run.h"
#include "schema/uncertainty/budget.h"
#include "schema/uncertainty/run_uncertainty.h"

namespace mdof::charts {

using output::Language;

// A run as the commands state it.
struct StatedResults {
  Run run;
  RunUncertainty uncertainty;            // of its points
  StatedFigures figures;                 // budgets, or why there are none
  std::vector<StraightnessLines> lines;  // about which straightness is stated
};

// Each says whether there is anything to show, and draws it then.
bool has_five_errors(const StatedResults& results);
std::string five_errors_svg(const StatedResults& results, Language language);

bool has_straightness(const StatedResults& results);
std::string straightness_svg(const StatedResults& results, Language language);

// What the visits of a target from the same side differ by, over the position and over the time of
// the run. Both need a target that was visited again.
bool has_repeatability(const StatedResults& results);
std::string repeatability_svg(const StatedResults& results, Language language);
std::string drift_svg(const StatedResults& results, Language language);

// Of one figure; `title_of` says of which runs. Where u is 0 or not known there is nothing to show.
bool has_budget(const Budget& budget);
std::string budget_svg(const Budget& budget, const std::string& title_of,
                       const std::vector<std::string>& marks, Language language);

// `marks` as of a run.
bool has_table(const CompensationTable& table);
std::string table_svg(const CompensationTable& table, const std::vector<std::string>& marks,
                      Language language);

// Two axes as they were measured against one square, their errors enlarged.
struct SquarenessResults {
  Squareness squareness;
  Budget budget;     // of EC0Y, EB0Z or EA0Z
  Run run_a, run_b;  // stated at the fixture
};
// Of two axes with one run each among several runs; nothing where it cannot be calculated.
struct SquarenessOfPair {
  AxisPair axes;
  std::optional<SquarenessResults> results;
  std::string reason;  // why there are no results
};
std::string squareness_svg(const SquarenessResults& results, Language language);

// All that there is to draw of a run.
struct RunCharts {
  std::vector<NamedChart> charts;
  std::vector<std::string> left_out;  // which chart and why, a sentence each
};
RunCharts charts_of_run(const StatedResults& results, Language language);

}  // namespace mdof::charts
