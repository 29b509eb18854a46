#include "tools/mdof/stored/stated_results.h"

#include <algorithm>

#include "algo/iso230/straightness.h"
#include "daemon/measure/budgets.h"
#include "daemon/measure/evaluation.h"
#include "daemon/measure/gate/gate.h"
#include "schema/imported/series.h"
#include "tools/mdof/stored/run_choice.h"

namespace mdof::tools {

Result<charts::StatedResults> stated_results(store::Store& store, std::int64_t run,
                                             Reference reference) {
  charts::StatedResults results;
  MDOF_TRY(results.run, daemon::run_stated_at(store, run, reference));
  MDOF_CHECK(check_measured(results.run.header, "charts of its five errors"));
  daemon::StatedRun stated = daemon::stated_run(results.run);
  results.uncertainty = std::move(stated.points);
  results.figures = std::move(stated.figures);
  results.lines = algo::straightness_lines(results.run.header.moving(), results.run.points);
  results.marks = daemon::marks_of(results.run);
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

Result<std::optional<charts::SquarenessResults>> squareness_of_runs(
    store::Store& store, const std::vector<const charts::StatedResults*>& runs) {
  const auto only = [&](Axis axis) -> const charts::StatedResults* {
    const auto is_along = [axis](const charts::StatedResults* r) {
      return r->run.header.axis == axis;
    };
    if (std::count_if(runs.begin(), runs.end(), is_along) != 1) return nullptr;
    return *std::find_if(runs.begin(), runs.end(), is_along);
  };
  const charts::StatedResults *x = only(Axis::x), *y = only(Axis::y);
  if (!x || !y) return std::optional<charts::SquarenessResults>();
  daemon::SquarenessRequest request;
  request.run_a = x->run.header.id;
  request.run_b = y->run.header.id;
  MDOF_TRY(auto fitted, daemon::calculate_squareness(store, request));
  charts::SquarenessResults results;
  results.squareness = fitted.squareness;
  results.budget = std::move(fitted.budgets.front());
  MDOF_TRY(results.run_a, daemon::run_stated_at(store, x->run.header.id, Reference::fixture));
  MDOF_TRY(results.run_b, daemon::run_stated_at(store, y->run.header.id, Reference::fixture));
  for (const auto* run : {x, y})
    results.marks.insert(results.marks.end(), run->marks.begin(), run->marks.end());
  return std::optional(std::move(results));
}

}  // namespace mdof::tools
