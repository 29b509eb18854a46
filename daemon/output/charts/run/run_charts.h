// Charts of a stored run, one function each: it takes results and returns an SVG document. Pure:
// the same results give the same bytes, without the time of creation. Drawn elements have their
// numbers as data-… attributes, in the units of the result documents.
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

// A run with everything that the commands state about it.
struct StatedResults {
  Run run;
  RunUncertainty uncertainty;            // uncertainty of its points
  StatedFigures figures;                 // budgets, or the reason why there are none
  std::vector<StraightnessLines> lines;  // reference lines of the straightness
};

// Each has_… function returns whether its chart has anything to show; only then call …_svg.
bool has_five_errors(const StatedResults& results);
std::string five_errors_svg(const StatedResults& results, Language language);

bool has_straightness(const StatedResults& results);
std::string straightness_svg(const StatedResults& results, Language language);

// Differences between the visits of a target from the same side, over the position and over the
// time of the run. Both charts need a target with several visits.
bool has_repeatability(const StatedResults& results);
std::string repeatability_svg(const StatedResults& results, Language language);
std::string drift_svg(const StatedResults& results, Language language);

// The budget of one figure; `title_of` names its runs. has_budget() is false if u is 0 or unknown.
bool has_budget(const Budget& budget);
std::string budget_svg(const Budget& budget, const std::string& title_of,
                       const std::vector<std::string>& marks, Language language);

// `marks`: as for a run.
bool has_table(const CompensationTable& table);
std::string table_svg(const CompensationTable& table, const std::vector<std::string>& marks,
                      Language language);

// Two axes that were measured against one square; the chart enlarges their errors.
struct SquarenessResults {
  Squareness squareness;
  Budget budget;     // budget of EC0Y, EB0Z or EA0Z
  Run run_a, run_b;  // stated at the fixture
};
// Squareness of two axes with one run each; nullopt if it cannot be calculated.
struct SquarenessOfPair {
  AxisPair axes;
  std::optional<SquarenessResults> results;
  std::string reason;  // why there are no results
};
std::string squareness_svg(const SquarenessResults& results, Language language);

// All charts of a run.
struct RunCharts {
  std::vector<NamedChart> charts;
  std::vector<std::string> left_out;  // one sentence for each chart that was left out
};
RunCharts charts_of_run(const StatedResults& results, Language language);

}  // namespace mdof::charts
