// Charts of a stored run. Each chart has a function that takes results and returns an SVG document.
// Pure: equal results make equal bytes, because a chart does not contain the time when it was made.
// Each drawn element has its numbers in data-… attributes, in the units of the result documents.
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

// A run with all results that the commands show for it.
struct StatedResults {
  Run run;
  RunUncertainty uncertainty;            // uncertainty of the points of the run
  StatedFigures figures;                 // budgets, or the reason why there are none
  std::vector<StraightnessLines> lines;  // reference lines of the straightness
};

// Each function has_X() returns whether there is data for the chart X. Call X_svg() only if has_X()
// is true.
bool has_five_errors(const StatedResults& results);
std::string five_errors_svg(const StatedResults& results, Language language);

bool has_straightness(const StatedResults& results);
std::string straightness_svg(const StatedResults& results, Language language);

// Differences between several visits of a target from the same side. repeatability_svg() draws them
// against the position, drift_svg() against the time. Both need at least one target with several
// visits.
bool has_repeatability(const StatedResults& results);
std::string repeatability_svg(const StatedResults& results, Language language);
std::string drift_svg(const StatedResults& results, Language language);

// The uncertainty budget of one figure. `title_of`: title that names the runs of the figure.
// has_budget() is false if u is 0 or unknown.
bool has_budget(const Budget& budget);
std::string budget_svg(const Budget& budget, const std::string& title_of,
                       const std::vector<std::string>& marks, Language language);

// The errors in a compensation table. `marks`: warnings that the chart shows at its top.
bool has_table(const CompensationTable& table);
std::string table_svg(const CompensationTable& table, const std::vector<std::string>& marks,
                      Language language);

// The squareness of two axes that were measured against the same square. The chart enlarges the
// errors of the axes.
struct SquarenessResults {
  Squareness squareness;
  Budget budget;     // budget of EC0Y, EB0Z or EA0Z
  Run run_a, run_b;  // the reference point of their errors is the fixture
};
// The squareness of a pair of axes. `results` is nullopt if the squareness cannot be calculated.
struct SquarenessOfPair {
  AxisPair axes;
  std::optional<SquarenessResults> results;
  std::string reason;  // why there are no results
};
std::string squareness_svg(const SquarenessResults& results, Language language);

// All charts of a run.
struct RunCharts {
  std::vector<NamedChart> charts;
  std::vector<std::string> left_out;  // one sentence for each omitted chart, with the reason
};
RunCharts charts_of_run(const StatedResults& results, Language language);

}  // namespace mdof::charts
