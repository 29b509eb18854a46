#include <string>

#include "daemon/measure/gate/gate.h"
#include "daemon/output/charts/analysis/analysis_charts.h"
#include "daemon/output/charts/plot_files.h"
#include "daemon/output/charts/run/points.h"
#include "daemon/output/charts/run/run_charts.h"
#include "schema/axis.h"
#include "schema/imported/series.h"

namespace mdof::charts {

using output::Phrase;
using output::phrase;

namespace {

void add_budgets(const StatedResults& results, RunCharts& all, Language language) {
  const std::string number = std::to_string(results.run.header.id);
  const std::string run = "run " + number;
  const std::vector<std::string> marks = daemon::warning_marks(results.run, language);
  const std::string title =
      phrase(Phrase::run_axis, language, {number, std::string(1, letter(results.run.header.axis))});
  for (const Budget& budget : results.figures.budgets)
    if (has_budget(budget))
      all.charts.push_back({"run-" + number + "-budget-" + file_name(budget.figure) + ".svg",
                            budget_svg(budget, title, marks, language)});
    else
      all.left_out.push_back(run + ": the chart of the budget of " + budget.figure +
                             " needs u, but u is unknown");
  if (results.figures.budgets.empty())
    all.left_out.push_back(
        run + ": the chart of the budget has no values: " +
        (results.figures.why.empty() ? "the run has no calculated results" : results.figures.why));
}

}  // namespace

RunCharts charts_of_run(const StatedResults& results, Language language) {
  const std::string number = std::to_string(results.run.header.id);
  const std::string run = "run " + number;
  RunCharts all;
  const auto add = [&](const std::string& name, std::string svg) {
    all.charts.push_back({"run-" + number + "-" + name + ".svg", std::move(svg)});
  };
  if (is_imported(results.run.header)) {
    all = imported_run_charts(results.run, language);
    add_budgets(results, all, language);
    return all;
  }
  if (!has_five_errors(results)) {
    all.left_out.push_back(run + ": no point has error values, so no chart can be drawn");
    return all;
  }
  add("five-errors", five_errors_svg(results, language));
  if (has_straightness(results))
    add("straightness", straightness_svg(results, language));
  else
    all.left_out.push_back(run + ": the chart of straightness needs at least three targets");
  if (has_repeatability(results)) {
    add("repeatability", repeatability_svg(results, language));
    add("drift", drift_svg(results, language));
  } else {
    all.left_out.push_back(run +
                           ": the charts of repeatability and drift need a target that was "
                           "measured at least twice with the same approach");
  }
  add_budgets(results, all, language);
  return all;
}

}  // namespace mdof::charts
