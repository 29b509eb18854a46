#include "tools/mdof/report/stated_results.h"

#include <algorithm>

#include "algo/iso230/straightness.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/imported/imported_run.h"
#include "daemon/measure/imported/positioning_figures.h"
#include "schema/imported/series.h"
#include "tools/mdof/stored/run_choice.h"

namespace mdof::tools {
namespace {

Result<charts::SquarenessResults> squareness_of_two(store::Store& store,
                                                    const charts::StatedResults& a,
                                                    const charts::StatedResults& b) {
  daemon::SquarenessRequest request;
  request.run_a = a.run.header.id;
  request.run_b = b.run.header.id;
  MDOF_TRY(auto fitted, daemon::calculate_squareness(store, request));
  charts::SquarenessResults results;
  results.squareness = fitted.squareness;
  results.budget = std::move(fitted.budgets.front());
  MDOF_TRY(results.run_a, daemon::restated_run(store, request.run_a, Reference::fixture));
  MDOF_TRY(results.run_b, daemon::restated_run(store, request.run_b, Reference::fixture));
  return results;
}

}  // namespace

Result<charts::StatedResults> stated_results(store::Store& store, std::int64_t run,
                                             Reference reference) {
  charts::StatedResults results;
  MDOF_TRY(results.run, daemon::restated_run(store, run, reference));
  if (is_imported(results.run.header)) {
    results.run = daemon::with_positioning_notices(std::move(results.run));
    results.figures = daemon::positioning_figures(results.run);
    const bool declared =
        !results.run.points.empty() && deviation_uncertainty(results.run.points.front()) > 0;
    results.uncertainty.noise_only = !declared;
    return results;
  }
  daemon::StatedRun stated = daemon::stated_run(results.run);
  results.uncertainty = std::move(stated.points);
  results.figures = std::move(stated.figures);
  results.lines = algo::straightness_lines(results.run.header.moving(), results.run.points);
  return results;
}

Result<std::vector<std::int64_t>> run_numbers(store::Store& store,
                                              const std::vector<std::string>& words,
                                              const std::string& axis) {
  std::vector<std::int64_t> numbers;
  for (const std::string& word : words) {
    MDOF_TRY(const std::int64_t number, run_number(store, word, axis_from(axis)));
    if (std::find(numbers.begin(), numbers.end(), number) == numbers.end())
      numbers.push_back(number);
  }
  return numbers;
}

std::vector<charts::SquarenessOfPair> squareness_of_runs(
    store::Store& store, const std::vector<const charts::StatedResults*>& runs) {
  const auto along = [&](Axis axis) {
    std::vector<const charts::StatedResults*> found;
    for (const charts::StatedResults* each : runs)
      if (each->run.header.axis == axis && !is_imported(each->run.header)) found.push_back(each);
    return found;
  };
  std::vector<charts::SquarenessOfPair> pairs;
  for (const AxisPair axes : daemon::kAxisPairs) {
    const auto a = along(axes.a), b = along(axes.b);
    if (a.empty() || b.empty()) continue;
    charts::SquarenessOfPair pair{axes, {}, ""};
    if (a.size() > 1 || b.size() > 1)
      pair.reason = std::string("the selection has several runs of axis ") +
                    letter(a.size() > 1 ? axes.a : axes.b) + "; choose one run of each axis";
    else if (auto results = squareness_of_two(store, *a.front(), *b.front()))
      pair.results = std::move(*results);
    else
      pair.reason = results.error().message;
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace mdof::tools
